// SPDX-License-Identifier: Apache-2.0
/// @file
/// What `tagfield sweep` and `tagfield_sweep_mpi` share: a sweep opened, its parts put together.
#pragma once

#include <string>

#include "tagfield/experiment/sweep/run_sweep.h"
#include "tagfield/experiment/sweep/sweep_folder.h"
#include "tagfield/experiment/sweep/sweep_plan.h"
#include "tagfield/sdf/load_world.h"

namespace tagfield {

inline constexpr double kSaveEvery_s = 5.0;  ///< So much work a killed process loses at most.

/// A sweep and its folder.
struct OpenSweep {
  SweepPlan plan;
  LogHead head;
  std::string suite;  ///< Path of its file.
  std::string folder;
  SweepMeans means;
  Diagnostics diagnostics;  ///< What is odd in its conditions, not printed yet.
};

/// Reads a suite and makes its folder, or finds that the folder is for it. `out`: "" for
/// runs/sweep_NAME. Throws Error.
OpenSweep open_sweep(const std::string& suite, const std::string& out,
                     const WorldOptions& world = {});

/// What merge_sweep() came to.
struct Merged {
  bool complete = false;
  bool closed_a_rung = false;  ///< So that there are more runs to do now.
  int exit_code = 0;
  std::string json;  ///< What results.json holds, where that was asked for.
};

/// Puts together what a folder's logs hold, writes the results beside them, and says what came out
/// and what is missing, or gives back JSON instead. Throws Error.
Merged merge_sweep(const std::string& folder, bool with_page, bool as_json = false);

/// Prints how far all shards are, as text or as JSON: `{suite, runs, done, failed, logs, rung,
/// rungs, core_hours}`. Throws Error.
int print_status(const std::string& folder, bool as_json = false);

}  // namespace tagfield
