// SPDX-License-Identifier: Apache-2.0
/// @file
/// What the paths of a known world do to a tag's phases about a place, and the phases without it.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tagfield/localization/problem.h"

namespace tagfield {

/// Replies of a tag about a place `p_WT` [m], traced from where the samples say that the antennas
/// are; by antenna and sample.
TracedReplies traced(const LocalizationProblem& problem, const std::string& tag,
                     const SamplesOfTag& samples, const Eigen::Vector3d& p_WT);

/// Bends of a slope over this are near a null of the field [m/m].
inline constexpr double kSteepestBend = 2.0;

/// Phase of a reply less that of the direct path alone, 2k|p − p_WA|, and how direct it came.
struct Bend {
  double phase_rad = 0.0;
  /// Amplitude of the direct path over the sum of all paths' amplitudes: 0 where it is blocked.
  double directness = 0.0;
  // By how much 1/2k of the phase grows with the tag's and with the antenna's place [m/m].
  Eigen::Vector3d by_place = Eigen::Vector3d::Zero();
  Eigen::Vector3d by_antenna = Eigen::Vector3d::Zero();
};

/// Numbers of channels, by antenna and frequency, in the order in which they are asked for.
class ChannelNumbers {
 public:
  std::size_t of(const std::string& antenna, double frequency_hz) {
    return numbers_.emplace(std::pair(antenna, frequency_hz), numbers_.size()).first->second;
  }

 private:
  std::map<std::pair<std::string, double>, std::size_t> numbers_;
};

/// A tag's samples, and the same with the antennas where they truly are, as far as that is known.
struct Sight {
  SamplesOfTag samples;
  SamplesOfTag corrected;
};

/// Samples without their bends, and the bends, by antenna, one for each sample.
struct Straightened {
  SamplesOfTag samples;
  std::map<std::string, std::vector<Bend>> bends;
};

/// With the tag at `p`, near the place that `replies` were traced to from `sight.corrected`.
/// Samples that hardly came the direct way are left out, and those near a null of the field, where
/// phases turn so fast that no slope holds for long; and outlying ones (outlying.h), of phases with
/// the noise `noise_rad`.
Straightened straightened(const LocalizationProblem& problem, const Sight& sight,
                          const TracedReplies& replies, const Eigen::Vector3d& p,
                          double least_directness, double noise_rad);

}  // namespace tagfield
