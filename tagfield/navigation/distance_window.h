// SPDX-License-Identifier: Apache-2.0
/// @file
/// Distance to the nearest static obstacle at each point around the robot.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/map/occupancy_grid.h"

namespace tagfield {

/// A square window of map cells with the distance from each cell to the nearest obstacle.
class DistanceWindow {
 public:
  /// Covers `half_m` to each side of `centre_M`. Obstacles are the occupied cells of `map` and the
  /// cells that contain one of `points_M`. Distances are capped at no more than two cells above
  /// `max_m`. `map` must have a resolution > 0 but may otherwise be empty.
  DistanceWindow(const OccupancyGrid& map, const std::vector<Eigen::Vector2d>& points_M,
                 const Eigen::Vector2d& centre_M, double half_m, double max_m);

  /// Distance [m], interpolated bilinearly between the centres of the four cells around `p_M`:
  /// within 0.7 cells of the distance to the nearest obstacle point. 0 outside the window.
  [[nodiscard]] double at(const Eigen::Vector2d& p_M) const;

 private:
  OccupancyGrid window_;
  std::vector<float> distances_;  ///< In cells.
};

}  // namespace tagfield
