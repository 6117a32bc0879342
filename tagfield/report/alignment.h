// SPDX-License-Identifier: Apache-2.0
/// @file
/// The rigid motion that brings places closest to others.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace tagfield {

/// A rotation and then a shift in the plane.
struct PlanarMotion {
  double yaw_rad = 0.0;
  Eigen::Vector2d shift_m = Eigen::Vector2d::Zero();

  Eigen::Vector2d operator*(const Eigen::Vector2d& p) const;
};

/// The motion with the least Σ|motion · from_i − to_i|² (Umeyama without scale, in the plane in
/// closed form). Both lists are equally long; of none it is the identity.
PlanarMotion best_motion(const std::vector<Eigen::Vector2d>& from,
                         const std::vector<Eigen::Vector2d>& to);

}  // namespace tagfield
