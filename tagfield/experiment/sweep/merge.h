// SPDX-License-Identifier: Apache-2.0
/// @file
/// Merges the logs of a sweep. The result does not depend on the shards, their order, or how often
/// they were killed.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tagfield/experiment/bench/bench.h"
#include "tagfield/experiment/store/result_log.h"
#include "tagfield/experiment/sweep/design.h"
#include "tagfield/experiment/sweep/sweep_plan.h"

namespace tagfield {

/// A run found in a log.
struct FoundRun {
  RunKey key;
  std::size_t log = 0;  ///< In RunIndex::logs.
  LogLocation place;
  bool failed = false;
  double cpu_s = 0.0;
};

/// The positions of all runs' results.
struct RunIndex {
  std::vector<std::string> logs;
  std::vector<FoundRun> runs;  ///< By point, then by seed, without duplicates.
  double cpu_s = 0.0;          ///< CPU time of all runs, including duplicates.
};

/// Indexes all logs without keeping their contents: about 50 bytes per run. If a run occurs several
/// times, a successful result is preferred over a failed one. Throws Error if two successful ones
/// differ, except in times, and if a log is of other work.
RunIndex index_runs(const std::vector<std::string>& logs, const LogHead& head,
                    Diagnostics& diagnostics);

struct FailedRun {
  RunKey key;
  std::string reason;
};

/// All results of one point.
struct PointResults {
  std::uint64_t point = 0;
  std::vector<BenchEntry> entries;  ///< One for each method that runs in it, in the suite's order.
  std::vector<FailedRun> failed;
  std::vector<std::string> warnings;  ///< Of its first seed.
};

/// Calls `take` for each point that has runs, in order. Runs of several points are read together,
/// opening each log once, up to a total of `max_bytes`; all runs of one point are always read
/// together.
void for_each_point(const SweepPlan& plan, const RunIndex& index,
                    const std::function<void(const PointResults&)>& take,
                    std::size_t max_bytes = std::size_t{1} << 28U);

/// The runs of `runs` that are not in the index.
std::vector<RunKey> missing_of(const std::vector<RunKey>& runs, const RunIndex& index);

/// The score of a point by the target of an adaptive sweep; less is better. A point with failed
/// runs, or without a value of the target, comes last.
double score_of(const PointResults& results, const Halving& halving);

/// Whether another rung was closed: if no run of the last open rung is missing, and it is not the
/// final one, its best points are added to `closed`.
bool close_rung(const SweepPlan& plan, const RunIndex& index, ClosedRungs& closed);

}  // namespace tagfield
