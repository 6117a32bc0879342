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
  int search_cells = 4;     ///< How far a point looks for its surface at first.
  double sigma_m = 0.02;    ///< Of a point beside its surface.
  double outlier_m = 0.06;  ///< Distance at which a point counts half (Cauchy's weight).
  /// Share of a point's information that counts: neighbouring beams err together, by what the map
  /// and the pose of its scans have wrong.
  double trust = 0.1;
  /// A cell weighs in its surface no more than so many ends. Without a limit the surface is where
  /// the ends are in the mean; a low one shifts it by up to half of their spread where a wall lies
  /// near the border of two cells.
  double most_ends = std::numeric_limits<double>::infinity();
};

struct ScanMatch {
  PlanarPose pose_M;
  /// Of x, y, yaw, the prior included [1/m², 1/m·rad, 1/rad²]. Its inverse is the covariance.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  double cost = 0.0;           ///< Half the sum of the weighted squares: minus a log likelihood.
  double matched_share = 0.0;  ///< Of the points, those that found a surface.
  double rms_m = 0.0;          ///< Of the matched points' distances from their surfaces.
};

/// Gauss-Newton on the distances of `points_R` from the surfaces near them, each the line through
/// the mean ends of the 3×3 cells around the nearest occupied one (or their mean, where they make
/// no line), with the prior N(prior_M, prior_information⁻¹).
ScanMatch match_scan(const HitGrid& map, const std::vector<Eigen::Vector2d>& points_R,
                     const PlanarPose& guess_M, const PlanarPose& prior_M,
                     const Eigen::Matrix3d& prior_information, const MatchOptions& options);

}  // namespace tagfield
