// SPDX-License-Identifier: Apache-2.0
/// @file
/// Checks whether stationary antennas read a single tag at rest, or several under one EPC.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tagfield/localization/method.h"
#include "tagfield/localization/problem.h"

namespace tagfield {

/// Scatter of the phases of one antenna on one carrier, as one group and as two.
struct PhaseScatter {
  /// Sum of squares about the mean as one group [rad²].
  double squares_of_one = 0.0;
  /// Sum of squares about the means of the best two arcs, of at least two reads each [rad²].
  double squares_of_two = 0.0;
  std::size_t reads = 0;
};

/// Scatter of at least four phases [rad].
PhaseScatter phase_scatter(const std::vector<double>& phases_rad);

/// Ratio of the variance as one group to that as two, over all channels with at least four reads of
/// the stationary antennas: 2 to 4 for the noise of one tag, including outliers, below 5 for random
/// phases, and far more for two tags. nullopt for fewer than 40 reads. Phases are multiplied by
/// `multiple`.
std::optional<double> group_ratio(const SamplesOfTag& samples, double multiple = 1.0);

/// Refuses tags whose phases at stationary antennas, taken modulo π, form two groups. They are
/// always taken modulo π because a π ambiguity may go unnoticed among the phases of two tags.
void refuse_groups(const LocalizationProblem& problem, LocalizationResult& result);

}  // namespace tagfield
