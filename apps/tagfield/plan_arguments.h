// SPDX-License-Identifier: Apache-2.0
/// @file
/// What is asked of a plan beside its file, made into the plan.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

#include "tagfield/report/plan.h"
#include "tagfield/scenario/plan_spec.h"

namespace tagfield {

struct PlanQuestion {
  std::uint64_t seed = 1;
  std::size_t samples = 32;     ///< Of each forecast.
  std::size_t check_seeds = 0;  ///< Runs of the chosen layout in full.
  double exact_s = 0.0;         ///< For which the exact solver may look; 0 for not at all.
  std::string links;            ///< Folder where links are kept; "" for nowhere.
  int threads = 1;
  const std::atomic<bool>* stop = nullptr;
  /// Called now and then with what is being done, "links", "layouts" or "check", and how much of
  /// that is.
  std::function<void(const std::string& stage, double share)> on_progress;
};

/// Throws Error where the exact solver is asked for and is not there, or knows no such aim: to be
/// asked before anything is computed.
void require_exact(const PlanQuestion& question, const PlanSpec& plan);

/// Links, layouts and the check; with its warnings. Throws Error as these do.
AntennaPlan plan_antennas(const ScenarioToPlan& to_plan, const PlanQuestion& question,
                          Diagnostics& diagnostics);

/// For people: the layouts, the chosen one, what becomes of it, and the check.
std::string plan_to_text(const AntennaPlan& plan);

}  // namespace tagfield
