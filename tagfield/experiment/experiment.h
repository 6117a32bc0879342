// SPDX-License-Identifier: Apache-2.0
/// @file
/// A whole experiment: simulate, localize, compare with the truth.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tagfield/localization/locate.h"
#include "tagfield/report/summary.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/simulator/navigation_run.h"
#include "tagfield/simulator/navigation_world.h"
#include "tagfield/simulator/simulation.h"
#include "tagfield/stream/recording.h"

namespace tagfield {

/// The result of another method for a run's reads.
struct ComparedMethod {
  std::string method;
  std::vector<TagOutcome> outcomes;  ///< In the scenario's order of tags.
};

/// One seed's run.
struct SeedRun {
  std::uint64_t seed = 0;
  bool complete = true;  ///< False if it was stopped.
  double simulated_s = 0.0;
  double path_length_m = 0.0;  ///< Driven by all robots.
  Recording recording;
  std::optional<NavigationRun> navigation;  ///< If robots navigate by themselves.
  std::string method;                       ///< The method that located the tags.
  std::string method_why;                   ///< Why "auto" chose it; "" if it was requested.
  std::vector<TagEstimate> estimates;       ///< In the scenario's order of tags.
  std::vector<TagOutcome> outcomes;         ///< In the same order.
  /// Errors of localization from the same reads with the true poses; empty if the believed poses
  /// are the true ones.
  std::vector<double> errors_with_true_pose_m;
  std::vector<AntennaPose> corrected_poses;  ///< From methods that estimate the pose error.
  /// Which tags were read, by which reader and how soon, if all antennas are stationary or nothing
  /// else is requested.
  std::optional<InventorySummary> inventory;
  std::vector<ComparedMethod> compared;  ///< None of them is `method`.
};

/// Simulates one seed, synchronized with real time if the scenario requests it. `world` is for
/// robots that navigate by themselves, which map it first unless a map is given; it may be null if
/// there are none.
SeedRun simulate(const Scenario& scenario, std::uint64_t seed, const RunControl& control,
                 const NavigationWorld* world = nullptr);

/// The error of the map as a whole: that of the mapping by the run's robot, or of a given map
/// (NavigationSpec::map_sigma_m); none without a map.
std::optional<MapError> map_error_of(const Scenario& scenario, const SeedRun& run);

/// Locates the tags from the run's reads and believed poses, unless localization is impossible or
/// not requested (why_inventory_alone()), and fills in all results. Of `control`, `threads`,
/// `on_stage` and `stop` are used: once that is set, the run is not complete, and either its tags
/// are not located or comparisons are missing; only reads of a simulation that was stopped before
/// are located to the end.
void localize(const Scenario& scenario, SeedRun& run, const RunControl& control,
              Diagnostics& diagnostics);

class RunStore;  // of store/run_store.h

/// Simulates and localizes `count` ≥ 1 seeds from `first` on, in parallel. Recordings are kept of
/// the first only. Seeds not begun when `control.stop` was set are left out. If `store` is given,
/// results of all seeds but the first are added to it, or taken from it (its keys: point 0, seed).
std::vector<SeedRun> run_seeds(const Scenario& scenario, std::uint64_t first, std::size_t count,
                               const RunControl& control, Diagnostics& diagnostics,
                               const NavigationWorld* world = nullptr, RunStore* store = nullptr);

/// How this scenario's tags are to be located.
LocalizationOptions localization_options(const Scenario& scenario, int threads);

/// The summary of all runs. `wall_s` is the wall-clock time they took.
Summary summarize(const Scenario& scenario, const std::vector<SeedRun>& runs, double wall_s,
                  const Diagnostics& diagnostics, const NavigationWorld* world = nullptr);

}  // namespace tagfield
