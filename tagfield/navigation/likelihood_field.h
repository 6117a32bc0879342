// SPDX-License-Identifier: Apache-2.0
/// @file
/// Likelihood of a scan at a pose on a map.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/map/occupancy_grid.h"
#include "tagfield/motion/unicycle.h"

namespace tagfield {

/// Positions of a map's cells, in single precision and with the origin at whole cells;
/// docs/localization_on_map.md says why.
struct CellFrame {
  explicit CellFrame(const OccupancyGrid& map);
  [[nodiscard]] Eigen::Vector2f centre_of(int x, int y) const;

  float resolution_m;
  Eigen::Vector2f origin;  ///< Outer corner of cell (0, 0) [m].
};

/// The likelihood field of Thrun, Burgard, Fox, Probabilistic Robotics (2005), section 6.4: a beam
/// endpoint in a cell at distance d from the nearest occupied one, centre to centre, has the
/// likelihood 0.9·exp(-d²/2σ²) + 0.1/3 m, where the second term accounts for what is not on the
/// map. d is capped at 4σ, which is also used off the map. The last row and column count as off the
/// map; points less than a cell before the first row or column count as in it.
class LikelihoodField {
 public:
  LikelihoodField(const OccupancyGrid& map, double sigma_m);

  /// Sum of the log-likelihoods of the endpoints. Accepts any pose.
  [[nodiscard]] double log_likelihood(const PlanarPose& pose_M,
                                      const std::vector<Eigen::Vector2f>& ends_R) const;

 private:
  [[nodiscard]] double log_at(double x, double y) const;

  CellFrame frame_;
  int width_;
  int height_;
  std::vector<double> logs_;  ///< Log-likelihood of each cell.
  double off_map_;
};

}  // namespace tagfield
