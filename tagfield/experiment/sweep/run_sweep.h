// SPDX-License-Identifier: Apache-2.0
/// @file
/// Does runs of a sweep and logs what comes of them.
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

/// What runs are made with.
struct SweepMeans {
  std::vector<Method> methods;  ///< Those that the suite may name.
  ReadRecording read;           ///< Of conditions with recordings.
};

/// Who gives out runs, one to each call, until there are none; may be called from any thread, one
/// at a time. Runs of the same point best come after one another: what a point needs is read once.
using NextRun = std::function<std::optional<RunKey>()>;

/// What became of the runs.
struct RunsDone {
  std::size_t ok = 0;
  std::size_t failed = 0;
};

/// Does the runs that `next` gives on `control.threads` threads. One that fails is logged with the
/// reason and the others go on. Ends early, with whole runs logged, where `control.stop` is set.
/// `on_run` is told of each that is done. Throws Error where the log can't be written.
RunsDone do_runs(const SweepPlan& plan, const SweepMeans& means, const NextRun& next,
                 ResultLog& log, const RunControl& control, const std::function<void()>& on_run);

/// Those of `runs` that none of the logs holds, in their order; failed ones count as done. What is
/// damaged is warned of.
std::vector<RunKey> not_done(const std::vector<RunKey>& runs, const std::vector<std::string>& logs,
                             const LogHead& head, Diagnostics& diagnostics);

/// Gives out a list.
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

/// Throws Error, as `tagfield bench` would, on what would make all runs of a condition fail: its
/// first point is made ready.
void require_runnable(const SweepPlan& plan, const SweepMeans& means, Diagnostics& diagnostics);

}  // namespace tagfield
