// SPDX-License-Identifier: Apache-2.0
/// @file
/// How a robot navigates by itself, as a plain struct.
#pragma once

#include <optional>
#include <string>

#include "tagfield/laser/simulated_laser.h"
#include "tagfield/motion/odometry_noise.h"
#include "tagfield/navigation/goal_driver.h"
#include "tagfield/navigation/grid_mapper.h"
#include "tagfield/navigation/monte_carlo_localizer.h"

namespace tagfield {

/// What a robot that drives by itself knows about its start pose.
enum class StartBelief {
  kKnown,    ///< Its pose, to within a few centimetres.
  kUnknown,  ///< Nothing.
  kRandom,   ///< Nothing, and the start is drawn anew for each seed from all poses it could have
             ///< driven to.
};

struct NavigationSpec {
  StartBelief start = StartBelief::kKnown;
  std::string map;  ///< YAML file of the map to navigate with; "" to make a map first.
  /// Error of a given map as a whole, standard deviation of its shift in x and y [m]; nullopt for
  /// that of its cells, cell/√12, as a wall may be anywhere in its cell.
  std::optional<double> map_sigma_m;
  /// Whether obstacles too low for the laser to see, but not too low to collide with, are known to
  /// the driver from the world file, as from a floor plan.
  bool keep_out = true;
  LaserParameters laser;
  OdometryNoise odometry;
  MapperSettings mapper;
  LocalizerSettings localizer;
  GoalDriverSettings driver;
  double mapping_speed_m_s = 0.5;
  double mapping_limit_s = 1800.0;  ///< Simulated time after which mapping ends, complete or not.
};

struct Scenario;

/// How the scenario's robots navigate.
const NavigationSpec& navigation_of(const Scenario& scenario);

/// Same, but for modifying this scenario without affecting its copies. The reference is valid until
/// the next call.
NavigationSpec& own_navigation(Scenario& scenario);

}  // namespace tagfield
