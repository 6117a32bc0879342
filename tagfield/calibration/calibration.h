// SPDX-License-Identifier: Apache-2.0
/// @file
/// The door of this room: reads of tags at known places in, what that tells of the antennas out;
/// and how it is put to use.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/localization/problem.h"
#include "tagfield/poses/trajectory.h"
#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// A figure and how sure it is.
struct CalibratedValue {
  double value = 0.0;
  double sigma = 0.0;
  bool observable = true;  ///< Whether the reads told it; otherwise it is what was known before.
};

/// Phase offset of one channel: φ = value + 4π r/λ [rad]; where half turns are, but for π.
struct ChannelOffset {
  double frequency_hz = 0.0;
  double value_rad = 0.0;  ///< In [0, 2π).
  double sigma_rad = 0.0;
  std::size_t reads = 0;
};

struct AntennaCalibration {
  int phase_sign = 1;  ///< −1 where reported phases fall with distance.
  /// Phase centre in the antenna's believed frame A [m].
  CalibratedValue place_m[3];
  CalibratedValue time_offset_s;  ///< Stamps of reads less this are those of poses.
  double noise_rad = 0.0;
  std::size_t reads = 0;
  std::vector<ChannelOffset> offsets;  ///< By rising frequency.
  /// Scatter of the offsets from tag to tag [rad]; an offset is given only where they agree.
  double tag_scatter_rad = 0.0;
};

struct Calibration {
  std::string name;
  bool half_turns = false;
  std::map<std::string, AntennaCalibration> antennas;
};

/// Corrects what a reader and a robot reported: signs of phases and stamps of `reads`, places of
/// `poses`, and tells `known` the offsets. Antennas without a calibration stay as they are.
void apply_calibration(const Calibration& calibration, std::vector<TagRead>& reads,
                       std::vector<AntennaPose>& poses, KnownBeforehand& known);

/// As a profile, which simulator/calibration_profile.h reads back. Its figures have nine digits.
std::string to_yaml(const Calibration& calibration);

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
