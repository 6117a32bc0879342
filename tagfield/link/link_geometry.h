// SPDX-License-Identifier: Apache-2.0
/// @file
/// Geometry of one antenna-tag link.
#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace tagfield {

/// What a channel model needs to know of where the two ends are.
struct LinkGeometry {
  double distance_m = 0.0;  ///< D of the paper's equations, greater than 0.
};

/// Link between an antenna at `p_WA` and a tag at `p_WT` [m]. Ends that coincide count as 1 µm
/// apart, so that no model divides by zero.
inline LinkGeometry link_between(const Eigen::Vector3d& p_WA, const Eigen::Vector3d& p_WT) {
  constexpr double kLeastDistance = 1e-6;
  return {std::max((p_WT - p_WA).norm(), kLeastDistance)};
}

}  // namespace tagfield
