// SPDX-License-Identifier: Apache-2.0
/// @file
/// Why a position remains hard to read.
#pragma once

#include <string>

#include "tagfield/layout/plan_problem.h"

namespace tagfield {

/// Margins of the best antenna's link to a position, over orientations and fading.
struct BestLink {
  std::string antenna;
  double distance_m = 0.0;
  double median_db = -400.0;
  double worst_turn_db = 0.0;  ///< The median in the worst orientation,
  double best_turn_db = 0.0;   ///< and in the best.
  bool arrives = false;
};

/// The best link from any antenna of a choice to one position of a group, with the plan's margin
/// subtracted.
BestLink best_link(const PlanSpec& plan, const LinkMatrix& matrix, const PlanProblem& problem,
                   const OptionSet& choice, std::size_t group, std::size_t place);

/// The reason in a few words.
std::string why_hard(const BestLink& link);

}  // namespace tagfield
