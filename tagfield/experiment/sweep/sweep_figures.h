// SPDX-License-Identifier: Apache-2.0
/// @file
/// A sweep as small multiples: the same axes repeated, with one panel per value of the remaining
/// keys. Each method has a colour of its own throughout.
#pragma once

#include <string>
#include <vector>

#include "tagfield/experiment/sweep/sweep_results.h"
#include "tagfield/report/figures.h"

namespace tagfield {

/// Mean error, then the share of tags located.
///
/// For a grid of up to three keys: the numeric key with most values on the horizontal axis, one
/// panel per combination of the others (and per condition), lines between neighbours, 95 % bars
/// from the standard error. For other designs one panel per key, one dot per point.
std::vector<Figure> sweep_figures(const SweepResults& results);

}  // namespace tagfield
