// SPDX-License-Identifier: Apache-2.0
/// @file
/// All reads of one tag in time order, prepared for tracking.
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

/// Prior of the tag's height.
struct HeightPrior {
  double mean_m = 0.0;
  double sigma_m = 0.0;
};

struct Pass {
  std::string tag;
  Time origin;                  ///< Halfway between the first and the last read.
  std::vector<PassRead> reads;  ///< In time order.
  std::vector<std::string> antennas;
  std::size_t groups = 0;
  HeightPrior height;
  std::size_t cut_off = 0;  ///< Reads left out because of too long a gap.
};

/// The reads of `tag`; if they have gaps longer than `max_gap_s`, the piece with the most reads.
Pass make_pass(const LocalizationProblem& problem, const std::string& tag,
               const TrackingOptions& options);

/// From the first read to the last [s].
double duration_of(const Pass& pass);

/// Mean antenna position over the reads [m].
Eigen::Vector3d middle_of_antennas(const Pass& pass);

}  // namespace tagfield
