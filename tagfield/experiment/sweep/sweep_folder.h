// SPDX-License-Identifier: Apache-2.0
/// @file
/// The folder of a sweep in progress: what is swept, and the logs of the runs by each process.
///
///     sweep.json                what is swept: tagfield's version, hash, the suite's text
///     shards/of_N/I.log         runs of shard I of N; by rank: shards/mpi_of_N/I.log
///     shards/again/I.log        repeated runs
///     rungs.json                of an adaptive sweep: the points kept after each rung
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/experiment/store/result_log.h"
#include "tagfield/experiment/sweep/sweep_plan.h"

namespace tagfield {

/// The sweep that a folder is for.
struct SweepSource {
  LogHead head;
  std::string suite;  ///< Absolute path of its file, on the machine where the sweep was started.
  std::string text;   ///< Of the suite.
};

/// Creates the folder for this sweep, or checks that an existing one is for it. Any number of
/// processes may do so concurrently. Throws Error if it is for another sweep, or can't be written.
void claim_sweep_folder(const std::string& folder, const SweepSource& source);

/// Reads which sweep the folder is for. Throws Error if it is not the folder of a sweep.
SweepSource read_sweep_source(const std::string& folder);

/// The part of the work done by a process.
struct Shard {
  std::size_t index = 1;  ///< From 1.
  std::size_t count = 1;
};

/// Parses "3/8". Throws Error.
Shard parse_shard(const std::string& text);

std::string shard_log(const std::string& folder, const Shard& shard);
std::string rank_log(const std::string& folder, const Shard& rank);
/// Path of a new log for repeated runs, one that does not exist yet.
std::string new_log_of_runs_again(const std::string& folder);

/// All logs, sorted by name.
std::vector<std::string> all_logs(const std::string& folder);

/// The logs that may contain runs of this shard: its own, and all that were not written by shards
/// with the same count. So concurrent shards don't read each other's logs.
std::vector<std::string> logs_for(const std::string& folder, const Shard& shard);

/// Throws Error if the file is damaged, or of another sweep.
ClosedRungs read_closed_rungs(const std::string& folder, const LogHead& head);
void write_closed_rungs(const std::string& folder, const LogHead& head, const ClosedRungs& closed);

}  // namespace tagfield
