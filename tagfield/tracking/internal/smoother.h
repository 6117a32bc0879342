// SPDX-License-Identifier: Apache-2.0
/// @file
/// Kalman filter and smoother of one pass, on wrapped phases.
///
/// State: place and velocity of the tag and a phase offset ψ for each antenna (or each antenna and
/// channel). Motion is of nearly constant velocity: p' = v, v' = white acceleration in x and y with
/// power density q². Phases are taken as φ = ψ + 4π/λ |p − a| + noise; innovations are wrapped.
#pragma once

#include <vector>

#include "tagfield/tracking/internal/line_search.h"
#include "tagfield/tracking/internal/pass.h"
#include "tagfield/tracking/tracker.h"

namespace tagfield {

/// How the phase is made linear in the state.
enum class Linearization {
  kTaylor,       ///< Slopes at one point: the extended Kalman filter.
  kSigmaPoints,  ///< Slopes over the spread of the state: the unscented Kalman filter.
};

/// Where the filter begins, and what the phases are measured with.
struct SmootherStart {
  Vector6d mean = Vector6d::Zero();   ///< What is known before any read, at the first one.
  Vector6d guess = Vector6d::Zero();  ///< Where the first iteration is to begin.
  Matrix6d covariance = Matrix6d::Identity();
  double noise_rad = 0.1;
};

/// Filters forward, smooths backward (Rauch, Tung and Striebel), then repeats both with each phase
/// made linear about the smoothed track, which also decides its turns; in between, the offset of
/// an antenna begins anew where its residuals jump, and the noise is taken from the residuals
/// unless `keep_noise`. With Taylor slopes and no process noise this is Gauss-Newton's way to the
/// maximum a posteriori (Bell, SIAM J. Optim. 1994).
Track smooth(const Pass& pass, const TrackingOptions& options, Linearization linearization,
             const SmootherStart& start, bool keep_noise = false);

/// A start from a straight motion: what is known beforehand, with what the reads tell of it at
/// `wider` times its spread (so that they count twice but for 1/wider²), and what process noise may
/// add over the pass.
SmootherStart start_from(const Pass& pass, const TrackingOptions& options,
                         const LineHypothesis& hypothesis, double wider = 10.0);

/// Root of the horizontal covariance's trace where the track is nearest to an antenna of the pass
/// [m].
double expected_error(const Pass& pass, const Track& track);

/// Covariance that white acceleration in x and y adds to (p, v) in `time_s`.
Matrix6d process_noise(const TrackingOptions& options, double time_s);

}  // namespace tagfield
