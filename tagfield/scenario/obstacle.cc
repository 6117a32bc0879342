// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "tagfield/base/trigonometry.h"
#include "tagfield/laser/simulated_laser.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {
namespace {

constexpr double kFarAway = 1e9;

double distance_to(const Rectangle& box, const Eigen::Vector2d& p_W) {
  const Eigen::Vector2d d = p_W - box.centre;
  const auto [s, c] = sine_cosine(box.yaw);
  const Eigen::Vector2d beyond =
      Eigen::Vector2d(c * d.x() + s * d.y(), -s * d.x() + c * d.y()).cwiseAbs() - box.size / 2.0;
  const double outside = beyond.cwiseMax(0.0).norm();
  return outside > 0.0 ? outside : beyond.maxCoeff();
}

}  // namespace

bool is_there(const ObstacleSpec& spec, Time stamp) {
  return stamp >= spec.appears && !(spec.disappears && stamp >= *spec.disappears);
}

Obstacles obstacles_at(const std::vector<ObstacleSpec>& specs, Time stamp) {
  Obstacles obstacles;
  for (const ObstacleSpec& spec : specs) {
    if (!is_there(spec, stamp)) continue;
    const Eigen::Vector2d centre = held_position_at(spec.motion, stamp).head<2>();
    if (spec.radius_m > 0.0) {
      obstacles.discs.push_back({centre, spec.radius_m});
    } else {
      obstacles.rectangles.push_back({centre, spec.size_m, spec.yaw_rad});
    }
  }
  return obstacles;
}

double distance_to_obstacles(const Obstacles& obstacles, const Eigen::Vector2d& p_W) {
  double least = kFarAway;
  for (const Disc& disc : obstacles.discs) {
    least = std::min(least, (p_W - disc.centre).norm() - disc.radius);
  }
  for (const Rectangle& box : obstacles.rectangles) least = std::min(least, distance_to(box, p_W));
  return least;
}

}  // namespace tagfield
