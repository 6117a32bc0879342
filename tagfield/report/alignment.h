// SPDX-License-Identifier: Apache-2.0
/// @file
/// The rigid motion that best aligns points with others.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace tagfield {

/// A rotation followed by a translation in the plane.
struct PlanarMotion {
  double yaw_rad = 0.0;
  Eigen::Vector2d shift_m = Eigen::Vector2d::Zero();

  Eigen::Vector2d operator*(const Eigen::Vector2d& p) const;
};

/// The motion that minimizes Σ|motion · from_i − to_i|² (Umeyama without scale, in the plane in
/// closed form). Both lists must have the same length; the result is the identity if they are
/// empty.
PlanarMotion best_motion(const std::vector<Eigen::Vector2d>& from,
                         const std::vector<Eigen::Vector2d>& to);

}  // namespace tagfield
