// SPDX-License-Identifier: Apache-2.0
/// @file
/// A run of robots that navigate by themselves, and what is measured during it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/scenario/scenario.h"
#include "tagfield/simulator/navigation_world.h"
#include "tagfield/simulator/place_watch.h"
#include "tagfield/simulator/self_driver.h"
#include "tagfield/simulator/simulation.h"
#include "tagfield/simulator/survey.h"

namespace tagfield {

/// Two robots that came to touch, as robots do not avoid one another.
struct RobotContact {
  std::string one;
  std::string other;
  double at_s = 0.0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< Of `one` [m].
};

/// Results of the navigation in one run.
struct NavigationRun {
  std::optional<Survey> survey;  ///< None if the map was given.
  OccupancyGrid map;             ///< The map used for navigation.
  std::vector<GoalOutcome> goals;
  std::vector<double> position_errors_m;  ///< Of the believed pose at 10 Hz,
  std::vector<double> yaw_errors_rad;     ///< absolute values.
  double closest_m = 0.0;  ///< Minimum distance between a robot's outline and anything,
  int collisions = 0;      ///< and number of contacts; both include mapping.
  std::vector<RobotContact> robot_contacts;  ///< Included in these.
  std::vector<Finding> findings;             ///< Of all robots.
  int times_lost = 0;
};

/// Result of such a run.
struct NavigatedRun {
  NavigationRun navigation;
  bool complete = true;
  double simulated_s = 0.0;
  double path_length_m = 0.0;
};

/// Makes the map unless the scenario gives one, and navigates with it. `outlets` receive what
/// antennas read.
NavigatedRun run_navigation(const Scenario& scenario, std::uint64_t seed, const RunControl& control,
                            const NavigationWorld& world, Outlets outlets);

}  // namespace tagfield
