// SPDX-License-Identifier: Apache-2.0
/// @file
/// How far a likelihood spreads about one of its maxima, by sums over ever finer grids.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "tagfield/localization/holograms/grid_search.h"

namespace tagfield {

/// ln of the likelihood of places [m].
using LogLikelihood = std::function<Tile(const Tile& x, const Tile& y, const Tile& z)>;

/// The likelihood taken for a density, over a box about a place.
struct LikelihoodSpread {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();        ///< [m]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< [m²]; z is 0 where it is level.
  double log_peak = 0.0;                                 ///< ln of the likelihood, greatest,
  double log_mass = 0.0;                                 ///< and of its integral.
};

/// A likelihood over the box ±0.45 m about a place, from which its spread is found.
struct FirstBox {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();  ///< [m]
  bool level = false;                               ///< z stays as it is.
  std::vector<double> logs;                         ///< ln of the likelihood at each cell.
};
FirstBox first_box(const LogLikelihood& likelihood, const Eigen::Vector3d& start, bool level);

/// Of the likelihood taken to the power of 1/`doubt`, `doubt` ≥ 1, over its first box, and then
/// over boxes of four and a half standard deviations about the mean, again and again until these
/// are at least as wide as a cell.
LikelihoodSpread likelihood_spread(const LogLikelihood& likelihood, const FirstBox& first,
                                   double doubt = 1.0);

/// The greatest of each likelihood over the box of so many standard deviations of `spread` about
/// its mean, at least 1 cm to each side.
std::vector<double> greatest_about(const LikelihoodSpread& spread, double deviations,
                                   const std::vector<LogLikelihood>& likelihoods);

}  // namespace tagfield
