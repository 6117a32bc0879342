// SPDX-License-Identifier: Apache-2.0
/// @file
/// Whether antennas at rest heard one tag at rest, or several under one EPC.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tagfield/localization/method.h"
#include "tagfield/localization/problem.h"

namespace tagfield {

/// What phases of one antenna on one carrier scatter, as one group and as two.
struct PhaseScatter {
  double squares_of_one = 0.0;  ///< Σ of squares about the mean of the shortest arc [rad²],
  double squares_of_two =
      0.0;  ///< and about those of the best two arcs, of two reads each at least.
  std::size_t reads = 0;
};

/// Of four phases [rad] or more.
PhaseScatter phase_scatter(const std::vector<double>& phases_rad);

/// Variance as one group over that as two, over all channels of the antennas that stood, of at
/// least four reads each: 2 to 4 of one tag's noise, outliers among them, below 5 of random phases,
/// and far more of two tags. None of fewer than 40 reads.
/// Phases count times `multiple`.
std::optional<double> group_ratio(const SamplesOfTag& samples, double multiple = 1.0);

/// Refuses tags whose phases at antennas at rest, known but for half turns, come in two groups:
/// among those of two tags half turns may not have been noticed.
void refuse_groups(const LocalizationProblem& problem, LocalizationResult& result);

}  // namespace tagfield
