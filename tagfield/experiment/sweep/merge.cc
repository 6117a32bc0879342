// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/sweep/merge.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "tagfield/experiment/bench/suite.h"
#include "tagfield/experiment/internal/statistics.h"
#include "tagfield/experiment/internal/sweep_target.h"
#include "tagfield/experiment/store/method_runs_json.h"
#include "tagfield/experiment/sweep/design.h"

namespace tagfield {
namespace {

/// Reads lines from a log.
class LogReader {
 public:
  explicit LogReader(const std::string& path)
      : path_(path), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (file_ < 0) fail({path_, 0}, fmt::format("can't be read: {}", std::strerror(errno)));
  }
  ~LogReader() { ::close(file_); }
  LogReader(const LogReader&) = delete;
  LogReader& operator=(const LogReader&) = delete;

  [[nodiscard]] std::string line(const LogLocation& place) const {
    std::string text(place.length, '\0');
    std::size_t done = 0;
    while (done < text.size()) {
      const ssize_t count = ::pread(file_, text.data() + done, text.size() - done,
                                    static_cast<off_t>(place.offset + done));
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) fail({path_, 0}, "can't be read: it has changed");
      done += static_cast<std::size_t>(count);
    }
    return text;
  }

 private:
  const std::string& path_;
  int file_;
};

std::string line_of_run(const RunIndex& index, const FoundRun& run) {
  return LogReader(index.logs[run.log]).line(run.place);
}

/// The run's result without run times, which differ each time.
std::string timeless(const RunIndex& index, const FoundRun& run) {
  const std::string line = line_of_run(index, run);
  const Location location{index.logs[run.log], 0};
  ConditionRun result = condition_run_in(logged_run_in(line, location).body, location);
  for (MethodRun& method : result.methods) method.seconds = 0.0;
  return to_json_line(result);
}

/// Successful results come first, then those in earlier logs.
bool goes_before(const FoundRun& a, const FoundRun& b) {
  if (a.key != b.key) return a.key < b.key;
  if (a.failed != b.failed) return b.failed;
  return std::pair(a.log, a.place.offset) < std::pair(b.log, b.place.offset);
}

void require_same(const RunIndex& index, const FoundRun& kept, const FoundRun& other) {
  if (kept.failed || other.failed) return;
  if (timeless(index, kept) == timeless(index, other)) return;
  throw Error(
      fmt::format("run {} came out differently in {} and {}: delete the one that can't be "
                  "trusted, and run again",
                  to_string(kept.key), index.logs[kept.log], index.logs[other.log]));
}

void keep_each_once(RunIndex& index) {
  std::sort(index.runs.begin(), index.runs.end(), goes_before);
  std::vector<FoundRun> kept;
  kept.reserve(index.runs.size());
  for (const FoundRun& run : index.runs) {
    if (kept.empty() || kept.back().key != run.key) {
      kept.push_back(run);
    } else {
      require_same(index, kept.back(), run);
    }
  }
  index.runs = std::move(kept);
}

/// Lines of the runs from `begin` to `end`, each log opened once.
std::vector<std::string> lines_of(const RunIndex& index, std::size_t begin, std::size_t end) {
  std::vector<std::size_t> order;
  for (std::size_t i = begin; i < end; ++i) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const FoundRun& one = index.runs[a];
    const FoundRun& other = index.runs[b];
    return std::pair(one.log, one.place.offset) < std::pair(other.log, other.place.offset);
  });
  std::vector<std::string> lines(end - begin);
  for (std::size_t i = 0; i < order.size();) {
    const std::size_t log = index.runs[order[i]].log;
    const LogReader reader(index.logs[log]);
    for (; i < order.size() && index.runs[order[i]].log == log; ++i) {
      lines[order[i] - begin] = reader.line(index.runs[order[i]].place);
    }
  }
  return lines;
}

PointResults empty_results(const SweepPlan& plan, std::uint64_t point) {
  PointResults results;
  results.point = point;
  const SweepPoint& of = plan.points[point];
  for (const SuiteMethod& method : plan.suite.methods) {
    if (!runs_in(method, plan.suite.conditions[of.condition])) continue;
    results.entries.push_back({of.name, method.name, method.method, {}});
  }
  return results;
}

void add_run(const LoggedRun& run, const Location& location, std::uint64_t first_seed,
             PointResults& results) {
  if (run.failed) {
    results.failed.push_back({run.key, std::string(run.body)});
    return;
  }
  ConditionRun found = condition_run_in(run.body, location);
  if (found.methods.size() != results.entries.size()) fail(location, "is not a run of this suite");
  for (std::size_t i = 0; i < found.methods.size(); ++i) {
    results.entries[i].runs.push_back(std::move(found.methods[i]));
  }
  if (run.key.seed == first_seed) results.warnings = std::move(found.warnings);
}

/// End of the runs of as many complete points from `begin` on as fit into `max_bytes`; at least
/// one point.
std::size_t window_end(const RunIndex& index, std::size_t begin, std::size_t max_bytes) {
  std::size_t bytes = 0;
  std::size_t whole = begin;
  for (std::size_t i = begin; i < index.runs.size(); ++i) {
    const bool new_point = i > begin && index.runs[i].key.point != index.runs[i - 1].key.point;
    if (new_point) whole = i;
    bytes += index.runs[i].place.length;
    if (bytes > max_bytes && whole > begin) return whole;
  }
  return index.runs.size();
}

void require_known_point(const SweepPlan& plan, const RunIndex& index, const FoundRun& run) {
  if (run.key.point < plan.points.size()) return;
  fail({index.logs[run.log], 0},
       fmt::format("has run {}, which the suite lacks", to_string(run.key)));
}

}  // namespace

RunIndex index_runs(const std::vector<std::string>& logs, const LogHead& head,
                    Diagnostics& diagnostics) {
  RunIndex index;
  index.logs = logs;
  for (std::size_t log = 0; log < logs.size(); ++log) {
    read_result_log(logs[log], head, diagnostics,
                    [&](const LoggedRun& run, const LogLocation& place) {
                      index.runs.push_back({run.key, log, place, run.failed, run.cpu_s});
                      index.cpu_s += run.cpu_s;
                    });
  }
  keep_each_once(index);
  return index;
}

void for_each_point(const SweepPlan& plan, const RunIndex& index,
                    const std::function<void(const PointResults&)>& take, std::size_t max_bytes) {
  for (std::size_t begin = 0; begin < index.runs.size();) {
    const std::size_t end = window_end(index, begin, max_bytes);
    const std::vector<std::string> lines = lines_of(index, begin, end);
    for (std::size_t i = begin; i < end;) {
      require_known_point(plan, index, index.runs[i]);
      PointResults results = empty_results(plan, index.runs[i].key.point);
      for (; i < end && index.runs[i].key.point == results.point; ++i) {
        const Location location{index.logs[index.runs[i].log], 0};
        add_run(logged_run_in(lines[i - begin], location), location, plan.suite.first_seed,
                results);
      }
      take(results);
    }
    begin = end;
  }
}

std::vector<RunKey> missing_of(const std::vector<RunKey>& runs, const RunIndex& index) {
  std::vector<RunKey> missing;
  for (const RunKey& key : runs) {
    const auto found =
        std::lower_bound(index.runs.begin(), index.runs.end(), key,
                         [](const FoundRun& run, const RunKey& of) { return run.key < of; });
    if (found == index.runs.end() || found->key != key) missing.push_back(key);
  }
  return missing;
}

double score_of(const PointResults& results, const Halving& halving) {
  const auto entry = std::find_if(results.entries.begin(), results.entries.end(),
                                  [&](const BenchEntry& of) { return of.name == halving.method; });
  if (entry == results.entries.end() || !results.failed.empty()) return kLastTargetValue;
  return target_value(statistics_of(*entry), halving.target);
}

namespace {

/// The results at the end of the rung, without those of later rungs.
PointResults only_seeds_below(const PointResults& results, std::uint64_t end) {
  PointResults kept = results;
  for (BenchEntry& entry : kept.entries) {
    std::erase_if(entry.runs, [&](const MethodRun& run) { return run.seed >= end; });
  }
  std::erase_if(kept.failed, [&](const FailedRun& run) { return run.key.seed >= end; });
  return kept;
}

}  // namespace

bool close_rung(const SweepPlan& plan, const RunIndex& index, ClosedRungs& closed) {
  if (closed.survivors.size() + 1 >= rung_seeds(plan).size()) return false;
  if (!missing_of(runs_of(plan, closed), index).empty()) return false;
  const Halving& halving = *plan.suite.sweep->adaptive;
  const std::uint64_t end = plan.suite.first_seed + rung_seeds(plan)[closed.survivors.size()];
  std::map<std::uint64_t, double> scores;
  for_each_point(plan, index, [&](const PointResults& results) {
    const bool is_in = closed.survivors.empty() ||
                       std::binary_search(closed.survivors.back().begin(),
                                          closed.survivors.back().end(), results.point);
    if (is_in) scores[results.point] = score_of(only_seeds_below(results, end), halving);
  });
  closed.survivors.push_back(best_of(scores, halving.keep_one_in));
  return true;
}

}  // namespace tagfield
