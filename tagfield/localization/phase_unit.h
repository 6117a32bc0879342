// SPDX-License-Identifier: Apache-2.0
/// @file
/// Whether phases are in radians.
#pragma once

#include "tagfield/localization/problem.h"

namespace tagfield {

/// The share of a cycle within which all phases lie of tags that an antenna read over at least 2 m
/// of its path, where phases take all values; 1 if there are fewer than two such tags or 100 such
/// reads. To 1/64.
double occupied_cycle(const SamplesByTag& samples);

}  // namespace tagfield
