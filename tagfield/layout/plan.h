// SPDX-License-Identifier: Apache-2.0
/// @file
/// From the specification of a plan to its layouts. See docs/plan.md.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tagfield/layout/link_matrix.h"
#include "tagfield/layout/plan_problem.h"
#include "tagfield/report/plan.h"
#include "tagfield/scenario/plan_spec.h"

namespace tagfield {

struct PlanRequest {
  std::uint64_t seed = 1;
  std::size_t samples = 32;  ///< Of each forecast.
  int threads = 1;           ///< The result does not depend on it.
  /// Time limit of the exact solver for the chosen layout [s]; 0 to skip it.
  double exact_s = 0.0;
  const std::atomic<bool>* stop = nullptr;
  std::function<void(double share)> on_progress;
};

/// The antennas of a choice, with names and readers: as many readers per zone as its ports need.
std::vector<PlannedAntenna> antennas_of(const PlanSpec& plan, const LinkMatrix& matrix,
                                        const PlanProblem& problem, const OptionSet& choice);

/// One tag of a sample: its position and orientation within its group.
struct PlanTag {
  std::size_t group = 0;
  std::size_t place = 0;
  std::size_t orientation = 0;
};
/// The tags of sample `number`, a function of the seed: for each group its number of tags, spread
/// over its positions, each with its own orientation.
std::vector<PlanTag> tags_of_sample(const PlanSpec& plan, std::uint64_t seed, std::size_t number);

/// All layouts, and details about the chosen one; without a check. Throws Error if the limits admit
/// no antenna, naming the limit at fault, and if it was stopped.
AntennaPlan make_plan(const ScenarioToPlan& to_plan, const LinkMatrix& matrix,
                      const PlanRequest& request);

}  // namespace tagfield
