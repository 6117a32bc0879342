// SPDX-License-Identifier: Apache-2.0
/// @file
/// Straight motion of a tag at constant speed, fitted to a pass.
#pragma once

#include <vector>

#include "tagfield/fit/intervals.h"
#include "tagfield/tracking/internal/pass.h"
#include "tagfield/tracking/tracker.h"

namespace tagfield {

/// p(t) = p + v t, t since the pass's origin.
struct StraightMotion {
  Eigen::Vector3d p_WT = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d v_WT = Eigen::Vector3d::Zero();  ///< [m/s]
};

/// Reads that share one phase offset: indices into Pass::reads.
using SubAperture = ReadInterval;

/// Cuts a pass into sub-apertures of up to `length_s`, each of one antenna and channel.
std::vector<SubAperture> sub_apertures(const Pass& pass, double length_s);

/// Gaussian prior of a motion, as weighted rows of A θ = b: height, climb, lane.
struct MotionPrior {
  Eigen::Matrix<double, 10, 6> rows;    ///< Each divided by its sigma; 0 if unknown.
  Eigen::Matrix<double, 10, 1> values;  ///< Divided by the same sigmas.
};

/// Prior from pass and options.
MotionPrior motion_prior(const Pass& pass, const TrackingOptions& options);

struct LineFit {
  StraightMotion motion;
  Matrix6d covariance = Matrix6d::Zero();  ///< Of (p, v) at the pass's origin.
  double coherence = 0.0;                  ///< Mean of cos(residual).
  double prior_cost = 0.0;                 ///< Half the sum of squares of the prior's residuals.
  double noise_rad = 0.0;                  ///< Of the residuals.
};

/// Maximum-likelihood fit to wrapped phases, with a separate phase offset for each sub-aperture
/// unless `fix_known` is set and its antenna's offset is known: minimizes Σ (1 − cos(φ_i − k_i
/// |p(t_i) − a_i| − ψ))/σ² by damped Gauss-Newton steps from `start`. `noise_rad` weighs the phases
/// against the prior.
LineFit fit_line(const Pass& pass, const std::vector<SubAperture>& apertures,
                 const MotionPrior& prior, double noise_rad, bool fix_known,
                 const StraightMotion& start);

}  // namespace tagfield
