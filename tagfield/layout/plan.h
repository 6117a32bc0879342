// SPDX-License-Identifier: Apache-2.0
/// @file
/// From what a plan is asked to its layouts. See docs/plan.md.
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
  /// How long the exact solver may look for the chosen layout [s]; 0 for not at all.
  double exact_s = 0.0;
  const std::atomic<bool>* stop = nullptr;
  std::function<void(double share)> on_progress;
};

/// The antennas of a choice, with names and readers: of each zone as many readers as its ports
/// need.
std::vector<PlannedAntenna> antennas_of(const PlanSpec& plan, const LinkMatrix& matrix,
                                        const PlanProblem& problem, const OptionSet& choice);

/// One tag of a sample: which place and orientation of its group it has.
struct PlanTag {
  std::size_t group = 0;
  std::size_t place = 0;
  std::size_t orientation = 0;
};
/// The tags of sample `number`: as many of each group as there are, over its places in turn, each
/// with an orientation of its own; a function of the seed.
std::vector<PlanTag> tags_of_sample(const PlanSpec& plan, std::uint64_t seed, std::size_t number);

/// All layouts, and what there is to say of the chosen one; without a check. Throws Error where the
/// limits let no antenna in, saying which one is at fault, and where it was stopped.
AntennaPlan make_plan(const ScenarioToPlan& to_plan, const LinkMatrix& matrix,
                      const PlanRequest& request);

}  // namespace tagfield
