// SPDX-License-Identifier: Apache-2.0
/// @file
/// The folder of a sweep while it is under way: what is swept, and the logs of who did which runs.
///
///     sweep.json                what is swept: tagfield's version, hash, the suite's text
///     shards/of_N/I.log         what shard I of N did, likewise shards/mpi_of_N/I.log by rank
///     shards/again/I.log        runs that were done again
///     rungs.json                of an adaptive sweep: who went on after each rung
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/experiment/store/result_log.h"
#include "tagfield/experiment/sweep/sweep_plan.h"

namespace tagfield {

/// What a sweep's folder is for.
struct SweepSource {
  LogHead head;
  std::string suite;  ///< Path of its file, absolute, where the sweep was begun.
  std::string text;   ///< Of the suite.
};

/// Makes the folder for this sweep, or finds that it is for it. Any number of processes may do so
/// at once. Throws Error where it is for another sweep, or can't be written to.
void claim_sweep_folder(const std::string& folder, const SweepSource& source);

/// Throws Error where the folder is none of a sweep.
SweepSource read_sweep_source(const std::string& folder);

/// Which part of the work a process does.
struct Shard {
  std::size_t index = 1;  ///< From 1 on.
  std::size_t count = 1;
};

/// "3/8". Throws Error.
Shard parse_shard(const std::string& text);

std::string shard_log(const std::string& folder, const Shard& shard);
std::string rank_log(const std::string& folder, const Shard& rank);
/// One that is not there yet.
std::string new_log_of_runs_again(const std::string& folder);

/// All logs, in order of their names.
std::vector<std::string> all_logs(const std::string& folder);

/// The logs that may hold runs of this shard: its own, and all that were not written by shards of
/// as many. So shards of one sweep don't read one another's.
std::vector<std::string> logs_for(const std::string& folder, const Shard& shard);

/// Throws Error where the file is damaged, or of another sweep.
ClosedRungs read_closed_rungs(const std::string& folder, const LogHead& head);
void write_closed_rungs(const std::string& folder, const LogHead& head, const ClosedRungs& closed);

}  // namespace tagfield
