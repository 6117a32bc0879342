// SPDX-License-Identifier: Apache-2.0
/// @file
/// All reads of one tag in order of time, as tracking looks at them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "tagfield/localization/problem.h"
#include "tagfield/tracking/tracker.h"

namespace tagfield {

/// One phase: φ = ψ + k |p(t) − a| + noise, with ψ the offset of its group.
struct PassRead {
  double t_s = 0.0;  ///< Since the pass's `origin`.
  Time stamp;
  double phase_rad = 0.0;
  double k = 0.0;             ///< 4π/λ [rad/m].
  Eigen::Vector3d p_WA;       ///< Antenna [m].
  Eigen::Vector3d v_WA;       ///< Its velocity [m/s].
  std::size_t antenna = 0;    ///< Index into `antennas`.
  std::size_t group = 0;      ///< Antenna and channel, which share an offset.
  bool offset_known = false;  ///< ψ = 0.
};

/// What is known of the tag's height.
struct HeightPrior {
  double mean_m = 0.0;
  double sigma_m = 0.0;
};

struct Pass {
  std::string tag;
  Time origin;                  ///< Halfway between the first and the last read.
  std::vector<PassRead> reads;  ///< In rising order of time.
  std::vector<std::string> antennas;
  std::size_t groups = 0;
  HeightPrior height;
  std::size_t cut_off = 0;  ///< Reads beyond a gap too long, left out.
};

/// The reads of `tag`; of pieces with gaps longer than `max_gap_s` between them the one with most
/// reads.
Pass make_pass(const LocalizationProblem& problem, const std::string& tag,
               const TrackingOptions& options);

/// From the first read to the last [s].
double duration_of(const Pass& pass);

/// Mean of the antennas' places, by reads [m].
Eigen::Vector3d middle_of_antennas(const Pass& pass);

}  // namespace tagfield
