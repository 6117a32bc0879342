// SPDX-License-Identifier: Apache-2.0
/// @file
/// Entry point of this module: calibrates antennas from reads of tags at known positions, and
/// applies the result.
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

/// A parameter and its uncertainty.
struct CalibratedValue {
  double value = 0.0;
  double sigma = 0.0;
  bool observable = true;  ///< Whether the reads determine it; otherwise it rests on the prior.
};

/// Phase offset of one channel: φ = value + 4π r/λ [rad]; modulo π if phases have a π ambiguity.
struct ChannelOffset {
  double frequency_hz = 0.0;
  double value_rad = 0.0;  ///< In [0, 2π).
  double sigma_rad = 0.0;
  std::size_t reads = 0;
};

struct AntennaCalibration {
  int phase_sign = 1;  ///< −1 if reported phases fall with distance.
  /// Phase centre in the antenna's believed frame A [m].
  CalibratedValue phase_centre_m[3];
  CalibratedValue time_offset_s;  ///< Latency of the reads' stamps relative to those of poses.
  double noise_rad = 0.0;
  std::size_t reads = 0;
  std::vector<ChannelOffset> offsets;  ///< Sorted by frequency.
  /// Scatter of the offsets from tag to tag [rad]; offsets are given only if the tags agree.
  double tag_scatter_rad = 0.0;
};

struct Calibration {
  std::string name;
  bool pi_ambiguity = false;
  std::map<std::string, AntennaCalibration> antennas;
};

/// Applies a calibration: corrects phase signs and stamps of `reads` and positions of `poses`, and
/// adds the offsets to `known`. Antennas without a calibration are left unchanged.
void apply_calibration(const Calibration& calibration, std::vector<TagRead>& reads,
                       std::vector<AntennaPose>& poses, KnownBeforehand& known);

/// Writes a profile that simulator/calibration_profile.h reads. Numbers have nine digits.
std::string to_yaml(const Calibration& calibration);

struct CalibrationOptions {
  double phase_centre_sigma_m = 0.1;  ///< Prior of each component of the position.
  double time_offset_sigma_s = 0.05;  ///< Prior of the time offset.
  double max_time_offset_s = 0.5;     ///< Largest time offset searched.
  double max_pose_gap_s = 0.5;        ///< Reads between poses further apart are left out.
};

/// Throws Error naming an option that is out of range or not finite.
void check(const CalibrationOptions& options);

/// Calibrates each antenna on its own, by robust least squares on wrapped phases. Parameters: the
/// phase centre d in the believed frame A, the time offset τ, an offset ψ for each channel:
///
///   s φ = ψ + 4π/λ |X_WA(t − τ) d − p_tag| + noise, s = ±1.
///
/// The first fits are over a grid of τ and both signs, with an offset for each tag and channel in
/// short time intervals, so that neither offsets nor whole cycles matter. The intervals are then
/// lengthened step by step; finally the offsets of a channel are shared by all tags if they agree.
/// Standard deviations assume independent residuals. Antennas with too few reads are left out with
/// a warning. `tags`: positions by ID [m, world]; reads of other tags are ignored.
Calibration calibrate(const std::vector<TagRead>& reads, const std::vector<AntennaPose>& poses,
                      const std::map<std::string, Eigen::Vector3d>& tags,
                      const CalibrationOptions& options, int threads, Diagnostics& diagnostics);

}  // namespace tagfield
