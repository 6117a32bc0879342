// SPDX-License-Identifier: Apache-2.0
/// @file
/// A run of robots that find their way by themselves, with what is watched on the way.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tagfield/scenario/scenario.h"
#include "tagfield/simulator/navigation_world.h"
#include "tagfield/simulator/place_watch.h"
#include "tagfield/simulator/self_driver.h"
#include "tagfield/simulator/simulation.h"
#include "tagfield/simulator/survey.h"

namespace tagfield {

/// How robots found their way in one run.
struct NavigationRun {
  std::optional<Survey> survey;  ///< None where the map was given.
  OccupancyGrid map;             ///< Driven by.
  std::vector<GoalOutcome> goals;
  std::vector<double> position_errors_m;  ///< Of the belief at 10 Hz,
  std::vector<double> yaw_errors_rad;     ///< absolute.
  double closest_m = 0.0;         ///< Least distance between a robot's outline and anything,
  int collisions = 0;             ///< and how often it came to touch; both while mapping, too.
  std::vector<Finding> findings;  ///< Of all robots.
  int times_lost = 0;
};

/// What came of such a run.
struct NavigatedRun {
  NavigationRun navigation;
  bool complete = true;
  double simulated_s = 0.0;
  double path_length_m = 0.0;
};

/// Makes the map, where the scenario gives none, and drives by it. `outlets` are told what antennas
/// read.
NavigatedRun run_navigation(const Scenario& scenario, std::uint64_t seed, const RunControl& control,
                            const NavigationWorld& world, Outlets outlets);

}  // namespace tagfield
