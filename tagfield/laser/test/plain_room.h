// SPDX-License-Identifier: Apache-2.0
/// @file
/// A room from −6 m to 4 m along x and −3 m to 5 m along y, seen from inside.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "tagfield/world/scene.h"

namespace tagfield {

inline constexpr double kWest = -6.0;
inline constexpr double kEast = 4.0;
inline constexpr double kSouth = -3.0;
inline constexpr double kNorth = 5.0;

inline Scene room() {
  Scene scene;
  scene.collisions = {{"room", Box{{kEast - kWest, kNorth - kSouth, 3.0}},
                       from_translation({0.5 * (kWest + kEast), 0.5 * (kSouth + kNorth), 1.0})}};
  return scene;
}

/// Distance from a point in the room to its wall in a given direction.
inline double to_wall(const Eigen::Vector2d& p, double angle) {
  const double inf = std::numeric_limits<double>::infinity();
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double x = c > 0.0 ? (kEast - p.x()) / c : (c < 0.0 ? (kWest - p.x()) / c : inf);
  const double y = s > 0.0 ? (kNorth - p.y()) / s : (s < 0.0 ? (kSouth - p.y()) / s : inf);
  return std::min(x, y);
}

}  // namespace tagfield
