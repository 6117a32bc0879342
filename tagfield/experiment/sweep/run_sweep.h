// SPDX-License-Identifier: Apache-2.0
/// @file
/// Executes runs of a sweep and logs their results.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tagfield/experiment/bench/prepared.h"
#include "tagfield/experiment/store/result_log.h"
#include "tagfield/experiment/sweep/sweep_plan.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield {

/// Resources for runs.
struct SweepMeans {
  std::vector<Method> methods;  ///< Those that the suite may name.
  ReadRecording read;           ///< For conditions with recordings.
};

/// Source of runs, one per call until there are none. It may be called from any thread, but not
/// concurrently. Runs of the same point should be consecutive: what a point needs is then loaded
/// once.
using NextRun = std::function<std::optional<RunKey>()>;

/// Number of runs done.
struct RunsDone {
  std::size_t ok = 0;
  std::size_t failed = 0;
};

/// Executes the runs given by `next` on `control.threads` threads. A failed run is logged with the
/// reason and the others continue. Ends early, with only complete runs logged, if `control.stop` is
/// set. Calls `on_run` after each run. Throws Error if the log can't be written.
RunsDone do_runs(const SweepPlan& plan, const SweepMeans& means, const NextRun& next,
                 ResultLog& log, const RunControl& control, const std::function<void()>& on_run);

/// Those of `runs` that are in none of the logs, in their order; failed ones count as done. Warns
/// about damaged lines.
std::vector<RunKey> not_done(const std::vector<RunKey>& runs, const std::vector<std::string>& logs,
                             const LogHead& head, Diagnostics& diagnostics);

/// A source of runs from a list.
class RunList {
 public:
  explicit RunList(std::vector<RunKey> runs) : runs_(std::move(runs)) {}
  [[nodiscard]] std::size_t size() const { return runs_.size(); }
  std::optional<RunKey> next() {
    if (given_ == runs_.size()) return std::nullopt;
    return runs_[given_++];
  }

 private:
  std::vector<RunKey> runs_;
  std::size_t given_ = 0;
};

/// Throws Error, as `tagfield bench` would, on anything that would make all runs of a condition
/// fail, by preparing its first point.
void require_runnable(const SweepPlan& plan, const SweepMeans& means, Diagnostics& diagnostics);

}  // namespace tagfield
