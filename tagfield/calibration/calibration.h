// SPDX-License-Identifier: Apache-2.0
/// @file
/// What is known of antennas from a calibration, and how it is put to use.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

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

}  // namespace tagfield
