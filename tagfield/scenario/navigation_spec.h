// SPDX-License-Identifier: Apache-2.0
/// @file
/// How a robot finds its way by itself, as a plain struct.
#pragma once

#include <string>

#include "tagfield/laser/simulated_laser.h"
#include "tagfield/motion/odometry_noise.h"
#include "tagfield/navigation/goal_driver.h"
#include "tagfield/navigation/grid_mapper.h"
#include "tagfield/navigation/monte_carlo_localizer.h"

namespace tagfield {

/// What a robot that drives by itself is told of where it begins.
enum class StartBelief {
  kKnown,    ///< Where it is, to some centimetres.
  kUnknown,  ///< Nothing.
  kRandom,   ///< Nothing, and it is put anywhere that it could have driven to, at each seed
             ///< elsewhere.
};

struct NavigationSpec {
  StartBelief start = StartBelief::kKnown;
  std::string map;  ///< A map's YAML file to drive by; "" to make one first.
  /// Whether what is too low for the laser to see, but not for the robot to hit, is known to the
  /// driver from the world's file, as from a floor plan.
  bool keep_out = true;
  LaserParameters laser;
  OdometryNoise odometry;
  MapperSettings mapper;
  LocalizerSettings localizer;
  GoalDriverSettings driver;
  double mapping_speed_m_s = 0.5;
  double mapping_limit_s = 1800.0;  ///< Simulated time after which mapping ends, whatever is left.
};

struct Scenario;

/// How the scenario's robots find their way.
const NavigationSpec& navigation_of(const Scenario& scenario);

/// Likewise, to be changed in this scenario and no copy of it. Holds until the next call.
NavigationSpec& own_navigation(Scenario& scenario);

}  // namespace tagfield
