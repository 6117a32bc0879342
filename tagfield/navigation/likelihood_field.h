// SPDX-License-Identifier: Apache-2.0
/// @file
/// How likely a scan is at a pose on a map.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/map/occupancy_grid.h"
#include "tagfield/motion/unicycle.h"

namespace tagfield {

/// Where a map's cells lie, in single precision and the origin at whole cells, as
/// docs/localization_on_map.md says why.
struct CellFrame {
  explicit CellFrame(const OccupancyGrid& map);
  [[nodiscard]] Eigen::Vector2f centre_of(int x, int y) const;

  float resolution_m;
  Eigen::Vector2f origin;  ///< Outer corner of cell (0, 0) [m].
};

/// The likelihood field of Thrun, Burgard, Fox, Probabilistic Robotics (2005), section 6.4: an end
/// of a beam in a cell at the distance d from the nearest occupied one, centre to centre, has the
/// likelihood 0.9·exp(-d²/2σ²) + 0.1/3 m, where the second is for what is not on the map. d counts
/// as 4σ where it is more, and off the map. The last row and column count as off the map, and what
/// is less than a cell before the first ones as in them.
class LikelihoodField {
 public:
  LikelihoodField(const OccupancyGrid& map, double sigma_m);

  /// Sum over the ends of the logarithms. Takes any pose.
  [[nodiscard]] double log_likelihood(const PlanarPose& pose_M,
                                      const std::vector<Eigen::Vector2f>& ends_R) const;

 private:
  [[nodiscard]] double log_at(double x, double y) const;

  CellFrame frame_;
  int width_;
  int height_;
  std::vector<double> logs_;  ///< Of each cell.
  double off_map_;
};

}  // namespace tagfield
