// SPDX-License-Identifier: Apache-2.0
/// @file
/// The side of the antennas on which heights are estimated.
#pragma once

#include "tagfield/localization/method.h"

namespace tagfield {

/// Removes positions of tags whose height is estimated that are on the other side of all antennas
/// than the stated one, by over three of their vertical errors: where antennas are at several
/// heights, a fit can end there.
void keep_on_height_side(const LocalizationProblem& problem, LocalizationResult& result);

}  // namespace tagfield
