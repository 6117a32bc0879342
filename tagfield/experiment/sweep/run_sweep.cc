// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/sweep/run_sweep.h"

#include <time.h>

#include <algorithm>
#include <list>
#include <memory>
#include <mutex>
#include <new>

#include "tagfield/base/parallel.h"
#include "tagfield/experiment/internal/condition_run.h"
#include "tagfield/experiment/store/method_runs_json.h"

namespace tagfield {
namespace {

/// A point prepared for running, or why it can't be.
struct ReadyPoint {
  std::once_flag once;
  PreparedSuite suite;
  std::string fault;
  std::vector<std::string> warnings;
};

void make_ready(const SweepPlan& plan, const SweepMeans& means, std::uint64_t point,
                ReadyPoint& ready) {
  Diagnostics diagnostics;
  try {
    ready.suite = prepare(suite_of_point(plan, point), means.methods, diagnostics, means.read);
    // A bench continues without a missing recording.
    if (ready.suite.conditions.empty()) ready.fault = diagnostics.warnings().at(0);
  } catch (const Error& error) {
    ready.fault = error.what();
  }
  ready.warnings = diagnostics.warnings();
}

/// Cache of the points of recent runs.
class ReadyPoints {
 public:
  ReadyPoints(const SweepPlan& plan, const SweepMeans& means, std::size_t most)
      : plan_(plan), means_(means), most_(most) {}

  std::shared_ptr<const ReadyPoint> get(std::uint64_t point) {
    const std::shared_ptr<ReadyPoint> ready = find(point);
    std::call_once(ready->once, [&] { make_ready(plan_, means_, point, *ready); });
    return ready;
  }

 private:
  std::shared_ptr<ReadyPoint> find(std::uint64_t point) {
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(points_.begin(), points_.end(),
                                    [&](const auto& entry) { return entry.first == point; });
    if (found != points_.end()) {
      points_.splice(points_.begin(), points_, found);
    } else {
      points_.emplace_front(point, std::make_shared<ReadyPoint>());
      if (points_.size() > most_) points_.pop_back();
    }
    return points_.front().second;
  }

  const SweepPlan& plan_;
  const SweepMeans& means_;
  std::size_t most_;
  std::mutex mutex_;
  std::list<std::pair<std::uint64_t, std::shared_ptr<ReadyPoint>>> points_;
};

/// CPU time of this thread [s].
double thread_cpu_s() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Outcome {
  bool failed = false;
  std::string body;
};

Outcome failure(const std::string& why) { return {true, as_one_line(why)}; }

/// None if it was stopped.
std::optional<Outcome> outcome_of(ReadyPoints& points, const RunKey& key,
                                  const RunControl& of_one) {
  try {
    const std::shared_ptr<const ReadyPoint> ready = points.get(key.point);
    if (!ready->fault.empty()) return failure(ready->fault);
    Diagnostics warnings;
    for (const std::string& warning : ready->warnings) warnings.warn(warning);
    auto methods = run_condition(ready->suite.conditions.front(), key.seed, of_one, warnings);
    if (!methods) return std::nullopt;
    return Outcome{false, to_json_line({std::move(*methods), warnings.warnings()})};
  } catch (const Error& error) {
    return failure(error.what());
  } catch (const std::bad_alloc&) {
    return failure("there is not enough memory for this");
  }
}

/// State shared by all threads of do_runs().
class Working {
 public:
  Working(const NextRun& next, const std::function<void()>& on_run)
      : next_(next), on_run_(on_run) {}

  std::optional<RunKey> next() {
    const std::lock_guard lock(mutex_);
    return next_();
  }

  void count(bool failed) {
    const std::lock_guard lock(mutex_);
    ++(failed ? done_.failed : done_.ok);
    if (on_run_) on_run_();
  }

  [[nodiscard]] const RunsDone& done() const { return done_; }

 private:
  const NextRun& next_;
  const std::function<void()>& on_run_;
  std::mutex mutex_;
  RunsDone done_;
};

void work(Working& working, ReadyPoints& points, ResultLog& log, const RunControl& control) {
  RunControl of_one;
  of_one.stop = control.stop;
  while (!stopped(control)) {
    const std::optional<RunKey> key = working.next();
    if (!key) return;
    const double begin_s = thread_cpu_s();
    const std::optional<Outcome> outcome = outcome_of(points, *key, of_one);
    if (!outcome) return;
    log.add({*key, outcome->failed, thread_cpu_s() - begin_s, outcome->body});
    working.count(outcome->failed);
  }
}

}  // namespace

RunsDone do_runs(const SweepPlan& plan, const SweepMeans& means, const NextRun& next,
                 ResultLog& log, const RunControl& control, const std::function<void()>& on_run) {
  const auto threads = static_cast<std::size_t>(std::max(control.threads, 1));
  ReadyPoints points(plan, means, threads + 1);
  Working working(next, on_run);
  parallel_for(threads, control.threads, [&](std::size_t) { work(working, points, log, control); });
  log.finish();
  return working.done();
}

std::vector<RunKey> not_done(const std::vector<RunKey>& runs, const std::vector<std::string>& logs,
                             const LogHead& head, Diagnostics& diagnostics) {
  std::set<RunKey> done;
  for (const std::string& log : logs) {
    read_result_log(log, head, diagnostics,
                    [&](const LoggedRun& run, const LogLocation&) { done.insert(run.key); });
  }
  std::vector<RunKey> left;
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(left),
               [&](const RunKey& key) { return done.count(key) == 0; });
  return left;
}

void require_runnable(const SweepPlan& plan, const SweepMeans& means, Diagnostics& diagnostics) {
  std::set<std::size_t> conditions;
  for (std::uint64_t point = 0; point < plan.points.size(); ++point) {
    if (!conditions.insert(plan.points[point].condition).second) continue;
    static_cast<void>(prepare(suite_of_point(plan, point), means.methods, diagnostics, means.read));
  }
}

}  // namespace tagfield
