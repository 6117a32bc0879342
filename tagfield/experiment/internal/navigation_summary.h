// SPDX-License-Identifier: Apache-2.0
/// @file
/// How robots found their way, in numbers over all seeds.
#pragma once

#include <vector>

#include "tagfield/experiment/experiment.h"

namespace tagfield {

/// A goal counts as reached where the robot says so and stands within this of it in truth [m].
inline constexpr double kTrulyThere_m = 0.2;

/// All runs have their `navigation`.
NavigationSummary navigation_summary(const std::vector<SeedRun>& runs,
                                     const NavigationWorld& world);

}  // namespace tagfield
