// SPDX-License-Identifier: Apache-2.0
/// @file
/// Kalman filter and smoother of one pass, on wrapped phases.
///
/// State: position and velocity of the tag and a phase offset ψ for each antenna (or each antenna
/// and channel). Nearly-constant-velocity motion: p' = v, v' = white acceleration in x and y with
/// power density q². Phases are modelled as φ = ψ + 4π/λ |p − a| + noise; innovations are wrapped.
#pragma once

#include <vector>

#include "tagfield/tracking/internal/line_search.h"
#include "tagfield/tracking/internal/pass.h"
#include "tagfield/tracking/internal/process_noise.h"
#include "tagfield/tracking/tracker.h"

namespace tagfield {

/// How the phase is linearized in the state.
enum class Linearization {
  kTaylor,       ///< Derivatives at one point: extended Kalman filter.
  kSigmaPoints,  ///< Regression over the spread of the state: unscented Kalman filter.
};

/// Initial state of the filter, and the phase noise.
struct SmootherStart {
  Vector6d mean = Vector6d::Zero();   ///< Prior at the time of the first read.
  Vector6d guess = Vector6d::Zero();  ///< Start of the first iteration.
  Matrix6d covariance = Matrix6d::Identity();
  double noise_rad = 0.1;
};

/// Filters forward, smooths backward (Rauch, Tung and Striebel), then repeats both with each phase
/// linearized around the smoothed track, which also resolves its whole turns. In between, an
/// antenna's offset is reset where its residuals jump, and the noise is estimated from the
/// residuals unless `keep_noise`. Where they are correlated, as with reflections, the covariances
/// are those of τ times the noise's variance, times fitted_away(τ)² (localization/residuals.h).
/// With Taylor linearization and no process noise, this is the Gauss-Newton iteration to the
/// maximum a posteriori (Bell, SIAM J. Optim. 1994).
Track smooth(const Pass& pass, const TrackingOptions& options, Linearization linearization,
             const SmootherStart& start, bool keep_noise = false);

/// Start from a straight motion: the prior, combined with the information from the reads at `wider`
/// times its standard deviation (so that only 1/wider² of it is counted twice), plus the process
/// noise over the pass.
SmootherStart start_from(const Pass& pass, const TrackingOptions& options,
                         const LineHypothesis& hypothesis, double wider = 10.0);

/// Square root of the horizontal covariance's trace at the track's closest approach to an antenna
/// of the pass [m].
double expected_error(const Pass& pass, const Track& track);

}  // namespace tagfield
