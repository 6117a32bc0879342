// SPDX-License-Identifier: Apache-2.0
/// @file
/// White acceleration of a tag: of the options' density in x and y, with a lane of at least the
/// lane's along it.
#pragma once

#include "tagfield/tracking/tracker.h"

namespace tagfield {

/// Square root of the power density in the direction with the most [m/s²/√Hz].
double largest_acceleration_noise(const TrackingOptions& options);

/// Covariance that it adds to (p, v) in `time_s`.
Matrix6d process_noise(const TrackingOptions& options, double time_s);

}  // namespace tagfield
