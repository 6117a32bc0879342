// SPDX-License-Identifier: Apache-2.0
/// @file
/// How far the nearest standing obstacle is from each place around the robot.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/map/occupancy_grid.h"

namespace tagfield {

/// A square of the map's cells with the distance of each to the nearest obstacle.
class DistanceWindow {
 public:
  /// `half_m` around `centre_M`: occupied cells of `map` and cells that hold one of `points_M`.
  /// Distances are no more than two cells above `most_m`. `map` has a resolution > 0 and may be
  /// empty else.
  DistanceWindow(const OccupancyGrid& map, const std::vector<Eigen::Vector2d>& points_M,
                 const Eigen::Vector2d& centre_M, double half_m, double most_m);

  /// Between the centres of the four cells around `p_M` bilinearly [m], which is within 0.7 cells
  /// of the distance to the nearest obstacle's point; 0 beyond the window.
  [[nodiscard]] double at(const Eigen::Vector2d& p_M) const;

 private:
  OccupancyGrid window_;
  std::vector<float> distances_;  ///< In cells.
};

}  // namespace tagfield
