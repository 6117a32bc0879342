// SPDX-License-Identifier: Apache-2.0
/// @file
/// Why a place stays hard to read.
#pragma once

#include <string>

#include "tagfield/layout/plan_problem.h"

namespace tagfield {

/// Margins of the best link of a place, by antenna, over orientations and fading.
struct BestLink {
  std::string antenna;
  double distance_m = 0.0;
  double median_db = -400.0;
  double worst_turn_db = 0.0;  ///< The median in the worst orientation,
  double best_turn_db = 0.0;   ///< and in the best.
  bool arrives = false;
};

/// Of all antennas of a choice to one place of a group, with the plan's margin taken off.
BestLink best_link(const PlanSpec& plan, const LinkMatrix& matrix, const PlanProblem& problem,
                   const OptionSet& choice, std::size_t group, std::size_t place);

/// In a few words.
std::string why_hard(const BestLink& link);

}  // namespace tagfield
