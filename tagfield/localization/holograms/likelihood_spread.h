// SPDX-License-Identifier: Apache-2.0
/// @file
/// Spread of a likelihood around one of its maxima, from sums over successively finer grids.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "tagfield/localization/holograms/grid_search.h"

namespace tagfield {

/// ln of the likelihood at points [m].
using LogLikelihood = std::function<Tile(const Tile& x, const Tile& y, const Tile& z)>;

/// Moments of the likelihood, treated as a density, over a box around a point.
struct LikelihoodSpread {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();        ///< [m]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< [m²]; z is 0 for a level box.
  double log_peak = 0.0;                                 ///< ln of the maximum likelihood,
  double log_mass = 0.0;                                 ///< and of the integral.
};

/// A local maximum of a likelihood.
struct Climbed {
  Eigen::Vector3d place;  ///< [m]
  double log = 0.0;       ///< ln of the likelihood.
};

/// The local maximum in 3D near a point: steps to the best of the 26 neighbours at a distance that
/// is halved from 8 cm to 1 mm. The cells of first_box() are too coarse there to find a narrow one.
Climbed climbed(const LogLikelihood& likelihood, const Eigen::Vector3d& start);

/// A likelihood over the box ±0.45 m around a point, the start of likelihood_spread().
struct FirstBox {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();  ///< [m]
  bool level = false;                               ///< z is fixed.
  std::vector<double> logs;                         ///< ln of the likelihood at each cell.
};
FirstBox first_box(const LogLikelihood& likelihood, const Eigen::Vector3d& start, bool level);

/// Spread of the likelihood raised to the power 1/`doubt`, `doubt` ≥ 1: over the first box, then
/// repeatedly over boxes of ±4.5 standard deviations around the mean until these no longer shrink
/// much.
LikelihoodSpread likelihood_spread(const LogLikelihood& likelihood, const FirstBox& first,
                                   double doubt = 1.0);

/// Maximum of each likelihood over the box of ±`deviations` standard deviations of `spread` around
/// its mean, at least ±1 cm.
std::vector<double> greatest_about(const LikelihoodSpread& spread, double deviations,
                                   const std::vector<LogLikelihood>& likelihoods);

}  // namespace tagfield
