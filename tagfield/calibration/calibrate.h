// SPDX-License-Identifier: Apache-2.0
/// @file
/// The door of this room: reads of tags at known places in, what they tell of the antennas out.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/calibration/calibration.h"

namespace tagfield {

struct CalibrationOptions {
  double place_sigma_m = 0.1;         ///< What is known of each component of the place before.
  double time_offset_sigma_s = 0.05;  ///< And of the time offset.
  double most_time_offset_s = 0.5;    ///< Offsets are looked for up to this.
  double max_pose_gap_s = 0.5;        ///< Reads between poses further apart are left out.
};

/// Throws Error naming the option that is out of its range or not finite.
void check(const CalibrationOptions& options);

/// Calibrates each antenna on its own, by robust least squares on wrapped phases. Parameters: the
/// phase centre d in the believed frame A, the time offset τ, an offset ψ for each channel:
///
///   s φ = ψ + 4π/λ |X_WA(t − τ) d − p_tag| + noise, s = ±1.
///
/// First with an offset for each tag and channel in short stretches of time, so that neither
/// offsets nor turns matter, over a grid of τ and both signs; then in ever longer ones; at last
/// with the offsets of a channel shared by all tags, where they agree. Standard deviations take
/// residuals for independent of each other. Antennas with too few reads are left out with a
/// warning. `tags`: places by ID [m, world]; reads of others are left out.
Calibration calibrate(const std::vector<TagRead>& reads, const std::vector<AntennaPose>& poses,
                      const std::map<std::string, Eigen::Vector3d>& tags,
                      const CalibrationOptions& options, int threads, Diagnostics& diagnostics);

}  // namespace tagfield
