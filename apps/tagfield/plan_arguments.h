// SPDX-License-Identifier: Apache-2.0
/// @file
/// Arguments of a plan besides its file, and the computation of the plan.
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
  std::size_t samples = 32;     ///< Per forecast.
  std::size_t check_seeds = 0;  ///< Full runs of the chosen layout.
  double exact_s = 0.0;         ///< Time limit of the exact solver; 0 to skip it.
  std::string links;            ///< Folder in which to cache links; "" for none.
  int threads = 1;
  const std::atomic<bool>* stop = nullptr;
  /// Called regularly with the current stage, "links", "layouts" or "check", and the share of it
  /// that is done.
  std::function<void(const std::string& stage, double share)> on_progress;
};

/// Throws Error if the exact solver is requested but not built in, or does not support the
/// objective; to be called before anything is computed.
void require_exact(const PlanQuestion& question, const PlanSpec& plan);

/// Computes links, layouts and the check, including warnings. Throws Error as these do.
AntennaPlan plan_antennas(const ScenarioToPlan& to_plan, const PlanQuestion& question,
                          Diagnostics& diagnostics);

/// Human-readable text: the layouts, the chosen one, its forecast, and the check.
std::string plan_to_text(const AntennaPlan& plan);

}  // namespace tagfield
