// SPDX-License-Identifier: Apache-2.0
/// @file
/// What stands or walks in a world besides the world at rest, such as a box or a person.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/base/time.h"
#include "tagfield/channel/material.h"
#include "tagfield/poses/trajectory.h"

namespace tagfield {

struct Obstacles;  // of laser/simulated_laser.h

/// What something that moves is to waves: as high as this, and made of that.
struct BodySpec {
  double height_m = 1.75;
  Material material;
};

/// Taller than a robot's laser; seen from above a disc, or a rectangle.
struct ObstacleSpec {
  std::string name;
  double radius_m = 0.0;                             ///< 0 for a rectangle.
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();  ///< Of the rectangle.
  double yaw_rad = 0.0;
  /// Where its middle is, x and y; one position for one that stands. Before the first and after
  /// the last it stays where that is.
  Trajectory motion;
  Time appears;
  std::optional<Time> disappears;
  std::optional<BodySpec> body;  ///< None: waves don't notice it.
  Location location;
};

/// Whether it is there at `stamp`.
bool is_there(const ObstacleSpec& spec, Time stamp);

/// Those that are there at `stamp`, where they are then.
Obstacles obstacles_at(const std::vector<ObstacleSpec>& specs, Time stamp);

/// Least distance from `p_W` to an obstacle's surface at `stamp` [m], negative inside; a large
/// number where there is none.
double distance_to_obstacles(const Obstacles& obstacles, const Eigen::Vector2d& p_W);

}  // namespace tagfield
