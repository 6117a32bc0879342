// SPDX-License-Identifier: Apache-2.0
/// @file
/// A tag on a straight line at constant speed: how well it explains a pass, and the fit of it.
#pragma once

#include <vector>

#include "tagfield/fit/stretches.h"
#include "tagfield/tracking/internal/pass.h"
#include "tagfield/tracking/tracker.h"

namespace tagfield {

/// p(t) = p + v t, t since the pass's origin.
struct StraightMotion {
  Eigen::Vector3d p_WT = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d v_WT = Eigen::Vector3d::Zero();  ///< [m/s]
};

/// Reads that share one phase offset: places in Pass::reads.
using SubAperture = ReadStretch;

/// Cuts a pass into sub-apertures of up to `length_s`, each of one antenna and channel.
std::vector<SubAperture> sub_apertures(const Pass& pass, double length_s);

/// Gaussian knowledge of a motion, as rows of A θ = b with weights: height, climb, lane.
struct MotionPrior {
  Eigen::Matrix<double, 10, 6> rows;    ///< Each divided by its sigma; 0 where nothing is known.
  Eigen::Matrix<double, 10, 1> values;  ///< Likewise.
};

/// What pass and options know.
MotionPrior motion_prior(const Pass& pass, const TrackingOptions& options);

struct LineFit {
  StraightMotion motion;
  Matrix6d covariance = Matrix6d::Zero();  ///< Of (p, v) at the pass's origin.
  double coherence = 0.0;                  ///< Mean of cos(residual).
  double prior_cost = 0.0;                 ///< Half the sum of squares of the prior's residuals.
  double noise_rad = 0.0;                  ///< Of the residuals.
};

/// Maximum likelihood on wrapped phases, each sub-aperture with a phase offset of its own unless
/// `fix_known` and its antenna's is known: minimizes Σ (1 − cos(φ_i − k_i |p(t_i) − a_i| − ψ))/σ²
/// by damped Gauss-Newton steps from `start`. `noise_rad` weighs the phases against the prior.
LineFit fit_line(const Pass& pass, const std::vector<SubAperture>& apertures,
                 const MotionPrior& prior, double noise_rad, bool fix_known,
                 const StraightMotion& start);

}  // namespace tagfield
