/// @file
/// How likely a scan is at a pose on a map.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/map/occupancy_grid.h"
#include "tagfield/motion/unicycle.h"

namespace tagfield {

/// The likelihood field of Thrun, Burgard, Fox, Probabilistic Robotics (2005), section 6.4: an end
/// of a beam at the distance d from the nearest occupied cell, centre to centre, has the
/// likelihood 0.9·exp(-d²/2σ²) + 0.1/3 m, the second for what is not on the map; d counts as 4σ
/// where it is more, and off the map.
class LikelihoodField {
 public:
  LikelihoodField(const OccupancyGrid& map, double sigma_m);

  /// Sum of the ends' log likelihoods. Takes any pose.
  [[nodiscard]] double log_likelihood(const PlanarPose& pose_M,
                                      const std::vector<Eigen::Vector2f>& ends_R) const;

 private:
  unsigned width_;
  unsigned height_;
  float resolution_m_;
  Eigen::Vector2f origin_;
  std::vector<double> logs_;  ///< Of each cell.
  double outside_;
};

}  // namespace tagfield
