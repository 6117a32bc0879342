// SPDX-License-Identifier: Apache-2.0
/// @file
/// What localization may know of a scenario before any read comes.
#pragma once

#include "tagfield/localization/problem.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// How far surfaces of a scenario's world may be off [m] where the reads may be of a real hall that
/// somebody measured; a run was simulated in that very world.
inline constexpr double kMeasuredWorldSigma_m = 0.01;

/// Heights, reference tags, offsets and the pose error's model, as far as the scenario's
/// `localization` says that they are known.
KnownBeforehand known_beforehand(const Scenario& scenario);

}  // namespace tagfield
