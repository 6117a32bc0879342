// SPDX-License-Identifier: Apache-2.0
/// @file
/// Positions on the other side of a path that is straight but for the error of its poses.
#pragma once

#include "tagfield/localization/method.h"

namespace tagfield {

/// Adds to each located tag the mirror image of its position across the antennas' path if that may
/// be straight but for a stated pose error (may_be_straight()). On a straight path only the error
/// distinguishes the sides, and it favours the wrong one as often, by as much: the residuals at
/// both sides contain the error's component across the path with opposite signs. With antennas at
/// several heights and an estimated height, the same holds across the plane of their positions.
/// Does nothing if poses are exact or their error is not stated.
void add_mirror_images(const LocalizationProblem& problem, int threads, LocalizationResult& result);

}  // namespace tagfield
