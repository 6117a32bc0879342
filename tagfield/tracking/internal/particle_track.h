// SPDX-License-Identifier: Apache-2.0
/// @file
/// Particle filter of one pass, on wrapped phases.
#pragma once

#include "tagfield/tracking/internal/smoother.h"

namespace tagfield {

/// Tracks with two particle filters, one forward and one backward in time, fused at each read as
/// two Gaussians (Fraser and Potter, IEEE T-AC 1969, with the common prior subtracted once). A
/// particle holds position, velocity and the mean of each offset, whose variance is tracked by a
/// Kalman filter (Rao-Blackwellized); after resampling, particles are spread by a kernel that
/// preserves mean and covariance (Liu and West 2001). Draws are a function of the options' seed,
/// the tag's ID and the read.
Track particle_track(const Pass& pass, const TrackingOptions& options, const SmootherStart& start);

}  // namespace tagfield
