// SPDX-License-Identifier: Apache-2.0
/// @file
/// Prior knowledge of localization about a scenario.
#pragma once

#include "tagfield/localization/problem.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Uncertainty of the surfaces of a scenario's world [m] if the reads may be from a real hall that
/// was surveyed. A simulated run has no such uncertainty.
inline constexpr double kMeasuredWorldSigma_m = 0.01;

/// Heights, reference tags, offsets, the drift of odometry and the model of the pose error, as far
/// as the scenario's `localization` states that they are known.
KnownBeforehand known_beforehand(const Scenario& scenario);

}  // namespace tagfield
