// SPDX-License-Identifier: Apache-2.0
/// @file
/// The logs of a sweep put together: the same whatever the shards, their order, and how often they
/// were killed.
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

/// A run that is in a log.
struct FoundRun {
  RunKey key;
  std::size_t log = 0;  ///< In RunIndex::logs.
  LogPlace place;
  bool failed = false;
  double cpu_s = 0.0;
};

/// Where each run's result stands.
struct RunIndex {
  std::vector<std::string> logs;
  std::vector<FoundRun> runs;  ///< By point, then by seed; each once.
  double cpu_s = 0.0;          ///< That all took, those among them that were done twice.
};

/// Reads all logs, without keeping what is in them: some 50 bytes a run. Of a run that is there
/// several times a whole result goes before a failed one. Throws Error where two whole ones differ,
/// times excepted, and where a log is of other work.
RunIndex index_runs(const std::vector<std::string>& logs, const LogHead& head,
                    Diagnostics& diagnostics);

struct FailedRun {
  RunKey key;
  std::string reason;
};

/// All that there is of one point.
struct PointResults {
  std::uint64_t point = 0;
  std::vector<BenchEntry> entries;  ///< One for each method that runs in it, in the suite's order.
  std::vector<FailedRun> failed;
  std::vector<std::string> warnings;  ///< Of its first seed.
};

/// Hands over each point that has runs, in order. Runs of several points are read at once, each log
/// opened once for them, as long as they take less than `most_bytes` together; of one point all.
void for_each_point(const SweepPlan& plan, const RunIndex& index,
                    const std::function<void(const PointResults&)>& take,
                    std::size_t most_bytes = std::size_t{1} << 28U);

/// The runs of `runs` that are not in the index.
std::vector<RunKey> missing_of(const std::vector<RunKey>& runs, const RunIndex& index);

/// How a point came out in what an adaptive sweep aims at; less is better. A point with failed
/// runs, or without what is aimed at, comes last.
double score_of(const PointResults& results, const Halving& halving);

/// Whether another rung was closed: where no run of the last open one is missing, and it is not the
/// last of all, its best points are added to `closed`.
bool close_rung(const SweepPlan& plan, const RunIndex& index, ClosedRungs& closed);

}  // namespace tagfield
