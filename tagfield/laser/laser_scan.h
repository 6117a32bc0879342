// SPDX-License-Identifier: Apache-2.0
/// @file
/// One scan of a planar laser scanner, real or simulated.
#pragma once

#include <vector>

#include "tagfield/base/time.h"

namespace tagfield {

/// Ranges at equally spaced angles about the scanner's z axis: beam i is at first_angle_rad +
/// i·angle_step_rad (scanner frame L: x forward, z up, so angles increase to the left) and at time
/// stamp + i·beam_interval.
struct LaserScan {
  Time stamp;                ///< Of the first beam.
  Duration beam_interval{};  ///< Between neighbouring beams; 0 if all are simultaneous.
  double first_angle_rad = 0.0;
  double angle_step_rad = 0.0;  ///< > 0.
  double min_range_m = 0.0;
  double max_range_m = 0.0;
  /// Finite. A return is in [min_range_m, max_range_m]; a larger value means no hit within
  /// range; 0 is an invalid beam (including too near).
  std::vector<float> ranges_m;
};

/// Kind of a beam's result.
enum class Beam { kReturn, kNothing, kInvalid };

inline Beam beam_of(const LaserScan& scan, float range_m) {
  if (range_m > static_cast<float>(scan.max_range_m)) return Beam::kNothing;
  return range_m >= static_cast<float>(scan.min_range_m) && range_m > 0.0F ? Beam::kReturn
                                                                           : Beam::kInvalid;
}

/// Range that represents no hit within `max_range_m` (finite, up to 1e6 m).
inline float nothing_range(double max_range_m) { return static_cast<float>(max_range_m) + 1.0F; }

/// Angle of beam `i` in L [rad].
inline double beam_angle(const LaserScan& scan, std::size_t i) {
  return scan.first_angle_rad + static_cast<double>(i) * scan.angle_step_rad;
}

}  // namespace tagfield
