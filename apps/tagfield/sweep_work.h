// SPDX-License-Identifier: Apache-2.0
/// @file
/// Shared by `tagfield sweep` and `tagfield_sweep_mpi`: opening a sweep, merging its parts.
#pragma once

#include <string>

#include "tagfield/experiment/sweep/run_sweep.h"
#include "tagfield/experiment/sweep/sweep_folder.h"
#include "tagfield/experiment/sweep/sweep_plan.h"
#include "tagfield/sdf/load_world.h"

namespace tagfield {

inline constexpr double kSaveEvery_s = 5.0;  ///< Work lost at most by a killed process.

/// A sweep and its folder.
struct OpenSweep {
  SweepPlan plan;
  LogHead head;
  std::string suite;  ///< Path of its file.
  std::string folder;
  SweepMeans means;
  Diagnostics diagnostics;  ///< Warnings about its conditions, not printed yet.
};

/// Reads a suite and creates its folder, or checks that an existing folder belongs to it. `out`: ""
/// for runs/sweep_NAME. Throws Error.
OpenSweep open_sweep(const std::string& suite, const std::string& out,
                     const WorldOptions& world = {});

/// Result of merge_sweep().
struct Merged {
  bool complete = false;
  bool closed_a_rung = false;  ///< So there are more runs to do now.
  int exit_code = 0;
  std::string json;  ///< Contents of results.json, if requested.
};

/// Merges a folder's logs, writes the results beside them, and prints a summary and what is
/// missing, or returns JSON instead. Throws Error.
Merged merge_sweep(const std::string& folder, bool with_page, bool as_json = false);

/// Prints the progress of all shards, as text or as JSON: `{suite, runs, done, failed, logs, rung,
/// rungs, core_hours}`. Throws Error.
int print_status(const std::string& folder, bool as_json = false);

}  // namespace tagfield
