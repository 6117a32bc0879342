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

/// What another method makes of a run's reads.
struct ComparedMethod {
  std::string method;
  std::vector<TagOutcome> outcomes;  ///< In the scenario's order of tags.
};

/// One seed's run.
struct SeedRun {
  std::uint64_t seed = 0;
  bool complete = true;  ///< False where it was stopped.
  double simulated_s = 0.0;
  double path_length_m = 0.0;  ///< Driven by all robots.
  Recording recording;
  std::optional<NavigationRun> navigation;  ///< Where robots find their way by themselves.
  std::string method;                       ///< That located the tags.
  std::string method_why;                   ///< Why "auto" chose it; "" where it was asked for.
  std::vector<TagEstimate> estimates;       ///< In the scenario's order of tags.
  std::vector<TagOutcome> outcomes;         ///< Likewise.
  /// Errors of the same reads located with the true poses; empty where those are believed anyway.
  std::vector<double> errors_with_true_pose_m;
  std::vector<AntennaPose> corrected_poses;  ///< Of methods that estimate the poses' error.
  /// Who was read, by whom and how soon, where all antennas stand still or nothing else is asked.
  std::optional<InventorySummary> inventory;
  std::vector<ComparedMethod> compared;  ///< None of them the same as `method`.
};

/// Simulates one seed, in step with real time if the scenario asks for it. `world` is for robots
/// that find their way by themselves, and may be null where none does: these map it first, unless a
/// map is given.
SeedRun simulate(const Scenario& scenario, std::uint64_t seed, const RunControl& control,
                 const NavigationWorld* world = nullptr);

/// Of the map that the run's robot has made of the world; none where it was given or not needed.
std::optional<MapError> map_error_of(const Scenario& scenario, const SeedRun& run);

/// Locates the tags from the run's reads and believed poses, unless nothing can be or shall be
/// located (why_inventory_alone()), and fills in all that comes of it.
void localize(const Scenario& scenario, SeedRun& run, int threads, Diagnostics& diagnostics,
              const OnLocating& on_locating = {});

class RunStore;  // of store/run_store.h

/// Simulates and localizes `count` ≥ 1 seeds from `first` on, in parallel. Recordings are kept of
/// the first only. Seeds not begun when `control.stop` was set are left out. What others than the
/// first come to goes into `store`, where given, or is taken from there (its keys: point 0, seed).
std::vector<SeedRun> run_seeds(const Scenario& scenario, std::uint64_t first, std::size_t count,
                               const RunControl& control, Diagnostics& diagnostics,
                               const NavigationWorld* world = nullptr, RunStore* store = nullptr);

/// How this scenario's tags are to be located.
LocalizationOptions localization_options(const Scenario& scenario, int threads);

/// The numbers of all runs. `wall_s` is how long they took.
Summary summarize(const Scenario& scenario, const std::vector<SeedRun>& runs, double wall_s,
                  const Diagnostics& diagnostics, const NavigationWorld* world = nullptr);

}  // namespace tagfield
