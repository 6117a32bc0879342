// SPDX-License-Identifier: Apache-2.0
/// @file
/// Statistics of robot navigation over all seeds.
#pragma once

#include <vector>

#include "tagfield/experiment/experiment.h"

namespace tagfield {

/// A goal counts as reached if the robot says so and is truly within this distance of it [m].
inline constexpr double kTrulyThere_m = 0.2;

/// Warns of robots that drove through one another, once for all runs.
void warn_of_robot_contacts(const std::vector<SeedRun>& runs, Diagnostics& diagnostics);

/// All runs must have their `navigation`.
NavigationSummary navigation_summary(const std::vector<SeedRun>& runs,
                                     const NavigationWorld& world);

}  // namespace tagfield
