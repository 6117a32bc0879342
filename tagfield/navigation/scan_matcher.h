// SPDX-License-Identifier: Apache-2.0
/// @file
/// Fits a scan to a map.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "tagfield/motion/unicycle.h"
#include "tagfield/navigation/hit_grid.h"

namespace tagfield {

struct MatchOptions {
  int iterations = 12;
  int search_cells = 4;     ///< Initial search radius of a point for its surface.
  double sigma_m = 0.02;    ///< Of a point's distance from its surface.
  double outlier_m = 0.06;  ///< Distance at which a point's weight is one half (Cauchy).
  /// Fraction of a point's information that counts: the errors of neighbouring beams are correlated
  /// through errors of the map and of the poses of its scans.
  double trust = 0.1;
  /// A cell weighs in its surface no more than this many endpoints. Without a limit the surface is
  /// at the mean of the endpoints; a low limit shifts it by up to half of their spread where a wall
  /// lies near the border of two cells.
  double max_ends = std::numeric_limits<double>::infinity();
};

struct ScanMatch {
  PlanarPose pose_M;
  /// Information matrix of x, y, yaw, prior included [1/m², 1/m·rad, 1/rad²]. Its inverse is the
  /// covariance.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  double cost = 0.0;           ///< Half the sum of the weighted squares: a negative log-likelihood.
  double matched_share = 0.0;  ///< Fraction of the points that found a surface.
  double rms_m = 0.0;          ///< Of the matched points' distances from their surfaces.
};

/// Gauss-Newton on the distances of `points_R` from the surfaces near them, with the prior
/// N(prior_M, prior_information⁻¹). A surface is the line through the mean endpoints of the 3×3
/// cells around the nearest occupied one, or their mean if they don't form a line.
ScanMatch match_scan(const HitGrid& map, const std::vector<Eigen::Vector2d>& points_R,
                     const PlanarPose& guess_M, const PlanarPose& prior_M,
                     const Eigen::Matrix3d& prior_information, const MatchOptions& options);

}  // namespace tagfield
