// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <numeric>

#include "tagfield/base/parallel.h"
#include "tagfield/experiment/bench/bench.h"
#include "tagfield/experiment/bench/suite.h"
#include "tagfield/experiment/internal/condition_run.h"
#include "tagfield/experiment/internal/faults.h"
#include "tagfield/experiment/internal/weighed_share.h"
#include "tagfield/experiment/store/method_runs_json.h"
#include "tagfield/experiment/store/run_store.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield {
namespace fs = std::filesystem;
namespace {

/// One condition with one seed, and its results.
struct Job {
  const PreparedCondition* condition = nullptr;
  RunKey key;
  std::optional<std::vector<MethodRun>> runs;
  Diagnostics warnings;
};

/// Index of a condition in the suite; not that among the prepared ones, which omit missing
/// recordings.
std::uint64_t place_of(const Suite& suite, const std::string& condition) {
  const auto found = std::find_if(suite.conditions.begin(), suite.conditions.end(),
                                  [&](const Condition& of) { return of.name == condition; });
  return static_cast<std::uint64_t>(found - suite.conditions.begin());
}

std::vector<Job> jobs_of(const PreparedSuite& prepared) {
  std::vector<Job> jobs;
  for (const PreparedCondition& condition : prepared.conditions) {
    const std::uint64_t place = place_of(prepared.suite, condition.condition.name);
    for (std::uint64_t i = 0; i < condition.runs; ++i) {
      jobs.push_back({&condition, {place, prepared.suite.first_seed + i}, std::nullopt, {}});
    }
  }
  return jobs;
}

/// Takes the job's results from the store, if it has them.
bool was_done(Job& job, const RunStore* store) {
  const std::string* const kept = store == nullptr ? nullptr : store->find(job.key);
  if (kept == nullptr) return false;
  ConditionRun found = condition_run_in(*kept, store->location());
  if (found.methods.size() != job.condition->methods.size()) return false;
  job.runs = std::move(found.methods);
  for (const std::string& warning : found.warnings) job.warnings.warn(warning);
  return true;
}

/// Returns whether the job had to be run: the store may have its results.
bool do_job(Job& job, const RunControl& control, RunStore* store) {
  if (was_done(job, store)) return false;
  try {
    job.runs = run_condition(*job.condition, job.key.seed, control, job.warnings);
  } catch (const Error& error) {
    const Condition& condition = job.condition->condition;
    fail(condition.location,
         fmt::format("condition '{}', seed {}: {}", condition.name, job.key.seed, error.what()));
  }
  if (store != nullptr && job.runs) {
    store->add(job.key, to_json_line({*job.runs, job.warnings.warnings()}));
  }
  return true;
}

/// Reports the share of the work that is done.
class Progress {
 public:
  Progress(const RunControl& control, const std::vector<Job>& jobs) : control_(control) {
    for (const Job& job : jobs) share_.expect(job.condition);
  }

  /// `seconds`: what the job took, or none if the store had its results.
  void add_one(const Job& job, std::optional<double> seconds) {
    const std::lock_guard lock(mutex_);
    share_.finish(job.condition, seconds);
    if (control_.on_progress) control_.on_progress(share_.done());
  }

 private:
  const RunControl& control_;
  std::mutex mutex_;
  WeighedShare<const PreparedCondition*> share_;
};

/// One seed of all conditions before the next, so that what each costs is known early; those whose
/// robots map and navigate, which take the longest, first.
std::vector<std::size_t> order_of(const std::vector<Job>& jobs) {
  std::vector<std::size_t> order(jobs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto rank = [&](std::size_t i) {
    return std::pair(jobs[i].key.seed, jobs[i].condition->world.has_value() ? 0 : 1);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  return order;
}

void run_all(std::vector<Job>& jobs, const RunControl& control, RunStore* store) {
  using Clock = std::chrono::steady_clock;
  RunControl of_one;
  of_one.stop = control.stop;
  Progress progress(control, jobs);
  const std::vector<std::size_t> order = order_of(jobs);
  parallel_for(jobs.size(), control.threads, [&](std::size_t i) {
    if (stopped(control)) return;
    Job& job = jobs[order[i]];
    const Clock::time_point begin = Clock::now();
    const bool is_run = do_job(job, of_one, store);
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    progress.add_one(job, is_run ? std::optional(seconds) : std::nullopt);
  });
}

BenchCondition described(const PreparedCondition& prepared) {
  BenchCondition condition;
  condition.name = prepared.condition.name;
  condition.scenario = prepared.scenario.name;
  condition.pose = to_string(prepared.scenario.pose.source);
  const auto& recording = prepared.condition.recording;
  if (recording) {
    condition.recording = fs::path(recording->reads).filename().string();
    condition.pose = "given";
  }
  if (prepared.condition.fault) condition.faults = fault_names(*prepared.condition.fault);
  condition.runs_planned = prepared.runs;
  condition.bound_knows_pose_error = true_pose_error(prepared.scenario).has_value();
  condition.no_bound = prepared.no_bound;
  return condition;
}

/// Conditions, and an entry without runs for each of their methods.
Bench empty_bench(const PreparedSuite& prepared) {
  Bench bench;
  bench.name = prepared.suite.name;
  bench.description = prepared.suite.description;
  for (const PreparedCondition& condition : prepared.conditions) {
    bench.conditions.push_back(described(condition));
    for (const PreparedMethod& method : condition.methods) {
      bench.entries.push_back({condition.condition.name, method.name, method.method.name, {}});
    }
  }
  return bench;
}

void add_warnings(const Job& job, std::uint64_t first_seed, Diagnostics& diagnostics) {
  if (job.key.seed != first_seed) return;
  for (const std::string& warning : job.warnings.warnings()) {
    diagnostics.warn(fmt::format("condition '{}', seed {}: {}", job.condition->condition.name,
                                 job.key.seed, warning));
  }
}

std::size_t count_located(const BenchEntry& entry, bool TagRecord::*property) {
  std::size_t count = 0;
  for (const MethodRun& run : entry.runs) {
    count += static_cast<std::size_t>(
        std::count_if(run.tags.begin(), run.tags.end(), [property](const TagRecord& tag) {
          return tag.*property && tag.verdict == Verdict::kLocated;
        }));
  }
  return count;
}

/// Errors can't be divided by a stated error of 0: such tags are left out, which must not go
/// unnoticed.
void warn_of_left_out(const BenchEntry& entry, Diagnostics& diagnostics) {
  const auto warn = [&](bool TagRecord::*property, const char* states, const char* left_out_of) {
    const std::size_t count = count_located(entry, property);
    if (count == 0) return;
    diagnostics.warn(fmt::format("condition '{}': method '{}' states {} for {} located tag{}: {}",
                                 entry.condition, entry.name, states, count, count == 1 ? "" : "s",
                                 left_out_of));
  };
  warn(&TagRecord::claims_no_error, "an expected error of 0",
       "left out of error_over_expected and NEES, and a false claim unless exact");
  warn(&TagRecord::flat_covariance, "a covariance without an inverse", "left out of NEES");
}

/// Distributes the runs of the jobs to their entries.
void collect(const PreparedSuite& prepared, std::vector<Job>& jobs, Bench& bench) {
  Diagnostics diagnostics;
  std::size_t first_entry = 0;
  const PreparedCondition* condition = jobs.empty() ? nullptr : jobs.front().condition;
  for (Job& job : jobs) {
    if (job.condition != condition) {
      first_entry += condition->methods.size();
      condition = job.condition;
    }
    add_warnings(job, prepared.suite.first_seed, diagnostics);
    if (!job.runs) {
      bench.complete = false;
      continue;
    }
    for (std::size_t i = 0; i < job.runs->size(); ++i) {
      bench.entries[first_entry + i].runs.push_back(std::move((*job.runs)[i]));
    }
  }
  for (const BenchEntry& entry : bench.entries) warn_of_left_out(entry, diagnostics);
  bench.warnings = diagnostics.warnings();
}

}  // namespace

Bench run_bench(const PreparedSuite& prepared, const RunControl& control, RunStore* store) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  std::vector<Job> jobs = jobs_of(prepared);
  run_all(jobs, control, store);
  Bench bench = empty_bench(prepared);
  collect(prepared, jobs, bench);
  bench.threads = control.threads;
  bench.wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  return bench;
}

Bench run_bench(const Suite& suite, const std::vector<Method>& methods, const RunControl& control) {
  Diagnostics diagnostics;
  const PreparedSuite prepared = prepare(suite, methods, diagnostics);
  Bench bench = run_bench(prepared, control);
  std::vector<std::string> warnings = diagnostics.warnings();
  warnings.insert(warnings.end(), bench.warnings.begin(), bench.warnings.end());
  bench.warnings = std::move(warnings);
  return bench;
}

}  // namespace tagfield
