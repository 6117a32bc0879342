// SPDX-License-Identifier: Apache-2.0
/// @file
/// Phase distortion ("bend") caused by the paths of a known world near a tag's position, and its
/// removal.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tagfield/localization/problem.h"

namespace tagfield {

/// Replies of a tag near the position `p_WT` [m], traced from the antenna positions of the samples;
/// by antenna and sample.
TracedReplies traced(const LocalizationProblem& problem, const std::string& tag,
                     const SamplesOfTag& samples, const Eigen::Vector3d& p_WT);

/// Bends with a steeper slope are near a null of the field [m/m].
inline constexpr double kSteepestBend = 2.0;

/// Phase of a reply minus that of the direct path alone, 2k|p − p_WA|, and the share of the direct
/// path.
struct Bend {
  double phase_rad = 0.0;
  /// Amplitude of the direct path over the sum of all paths' amplitudes; 0 if it is blocked.
  double directness = 0.0;
  // Derivatives of phase/2k with respect to the tag's and the antenna's position [m/m].
  Eigen::Vector3d by_place = Eigen::Vector3d::Zero();
  Eigen::Vector3d by_antenna = Eigen::Vector3d::Zero();
};

/// Indices of channels by antenna and frequency, assigned in the order of first use.
class ChannelNumbers {
 public:
  std::size_t of(const std::string& antenna, double frequency_hz) {
    return numbers_.emplace(std::pair(antenna, frequency_hz), numbers_.size()).first->second;
  }

 private:
  std::map<std::pair<std::string, double>, std::size_t> numbers_;
};

/// A tag's samples, and the same with corrected antenna positions.
struct Sight {
  SamplesOfTag samples;
  SamplesOfTag corrected;
};

/// Samples with their bends removed, and the bends per antenna, one for each sample.
struct Straightened {
  SamplesOfTag samples;
  std::map<std::string, std::vector<Bend>> bends;
};

/// Removes the bends for a tag at `p`, near the position that `replies` were traced to from
/// `sight.corrected`. Leaves out samples with little of the direct path, samples near a null of the
/// field, where the phase changes too fast to be linearized, and outliers (outlying.h) for a phase
/// noise of `noise_rad`.
Straightened straightened(const LocalizationProblem& problem, const Sight& sight,
                          const TracedReplies& replies, const Eigen::Vector3d& p,
                          double min_directness, double noise_rad);

}  // namespace tagfield
