// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/sweep_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "adapters/sqlite/database_file.h"
#include "apps/tagfield/command_line.h"
#include "apps/tagfield/program_version.h"
#include "apps/tagfield/scenario_arguments.h"
#include "apps/tagfield/shared_folder.h"
#include "apps/tagfield/suite_recording.h"
#include "tagfield/experiment/bench/suite.h"
#include "tagfield/experiment/store/work_hash.h"
#include "tagfield/experiment/sweep/merge.h"
#include "tagfield/experiment/sweep/sweep_figures.h"
#include "tagfield/experiment/sweep/sweep_page.h"
#include "tagfield/experiment/sweep/sweep_results.h"
#include "tagfield/experiment/sweep/sweep_tables.h"
#include "tagfield/experiment/sweep/sweep_text.h"
#include "tagfield/files/files.h"
#include "tagfield/files/staged_folder.h"
#include "tagfield/localization/locate.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxWarnings = 20;  // Printed individually.
constexpr std::size_t kMaxFailures = 20;  // Same.
constexpr std::size_t kMaxSuiteBytes = 16'000'000;
constexpr const char* kDatabase = "results.sqlite";

/// A sweep as described by its folder.
struct FoundSweep {
  SweepSource source;
  SweepPlan plan;
};

FoundSweep found_sweep(const std::string& folder) {
  FoundSweep found;
  found.source = read_sweep_source(folder);
  if (found.source.head.program != program_version()) {
    fail({folder, 0}, fmt::format("holds a sweep by tagfield {}, and this is {}: merge with that",
                                  found.source.head.program, program_version()));
  }
  found.plan = planned(suite_from_text(found.source.text, found.source.suite));
  return found;
}

std::string command_again(const std::string& suite, const std::string& folder,
                          const std::string& which) {
  return fmt::format("tagfield sweep {} --out {} --again {}", suite, folder, which);
}

/// The files of a merge that grow row by row.
class GrowingTables {
 public:
  GrowingTables(const SweepPlan& plan, StagedFolder& folder, const std::string& named)
      : runs_(folder.grow("runs.csv")) {
    runs_->text() += csv_header(runs_form());
    if (!sqlite::is_built_in()) return;
    folder.grow(kDatabase);
    database_ = std::make_unique<sqlite::DatabaseFile>((folder.staging() / kDatabase).string(),
                                                       named + "/" + kDatabase);
    database_->add_table(points_form(plan), {"point"});
    database_->add_table(results_form(), {"point", "name"});
    database_->add_table(runs_form(), {"point", "name", "seed"});
    database_->add_table(tags_form(), {"point", "name", "seed", "tag"});
    database_->add_table(failures_form(), {"point", "seed"});
    database_->run("CREATE VIEW sweep AS SELECT * FROM points JOIN results USING (point)");
  }

  void add(const PointResults& results) {
    give_runs(results, [&](const std::vector<Cell>& cells) {
      runs_->text() += csv_row(cells);
      runs_->sync();
      if (database_) database_->add_row("runs", cells);
    });
    if (!database_) return;
    give_tags(results, [&](const std::vector<Cell>& cells) { database_->add_row("tags", cells); });
  }

  void finish(const SweepResults& results) {
    if (!database_) return;
    for (std::uint64_t point = 0; point < results.plan.points.size(); ++point) {
      database_->add_row("points", point_cells(results, point));
    }
    for (const SweepRow& row : results.rows) database_->add_row("results", result_cells(row));
    for (const FailedRun& run : results.failed) {
      database_->add_row("failures", failure_cells(run));
    }
    database_->finish();
  }

 private:
  std::shared_ptr<GrowingFile> runs_;
  std::unique_ptr<sqlite::DatabaseFile> database_;
};

void add_warnings(const SweepPlan& plan, const PointResults& point, Diagnostics& warnings) {
  for (const std::string& warning : point.warnings) {
    warnings.warn(fmt::format("{}: {}", plan.points[point.point].name, warning));
  }
}

/// Limits the number of warnings, as many points of a sweep cause similar ones.
std::vector<std::string> fewer(const std::vector<std::string>& warnings) {
  if (warnings.size() <= kMaxWarnings) return warnings;
  std::vector<std::string> kept(warnings.begin(), warnings.begin() + kMaxWarnings);
  kept.push_back(fmt::format("… and {} more", warnings.size() - kMaxWarnings));
  return kept;
}

void stage_pages(const SweepResults& results, StagedFolder& folder) {
  const std::vector<Figure> figures = sweep_figures(results);
  for (const Figure& figure : figures) {
    if (!figure.missing.empty()) continue;
    folder.add("figures/" + figure.name + ".svg",
               standalone_svg(figure.svg, figure.title, figure.caption));
  }
  folder.add("sweep.html", sweep_page(results, figures));
}

void print_failures(const SweepResults& results, const FoundSweep& found,
                    const std::string& folder) {
  if (results.failed.empty()) return;
  fmt::print("{} failed:\n", results.failed.size() == 1
                                 ? std::string("1 run")
                                 : fmt::format("{} runs", results.failed.size()));
  for (std::size_t i = 0; i < std::min(results.failed.size(), kMaxFailures); ++i) {
    const FailedRun& run = results.failed[i];
    fmt::print("  {} ({}): {}\n    {}\n", to_string(run.key),
               results.plan.points[run.key.point].name, run.reason,
               command_again(found.source.suite, folder, to_string(run.key)));
  }
  if (results.failed.size() > kMaxFailures) {
    fmt::print("  … and {} more: table 'failures' of {} and results.json have all\n",
               results.failed.size() - kMaxFailures, kDatabase);
  }
  fmt::print("run all of them again:  {}\n", command_again(found.source.suite, folder, "failed"));
}

std::string left_text(const SweepResults& results, const FoundSweep& found,
                      const std::string& folder, bool closed_a_rung) {
  if (results.missing > 0 && !closed_a_rung) {
    return fmt::format(
        "INCOMPLETE: {} of {} runs are missing; resume with:  tagfield sweep {} --out {}\n",
        results.missing, results.planned, found.source.suite, folder);
  }
  if (results.complete()) return "";
  const std::size_t over = results.closed.survivors.size();
  return fmt::format("rung {} of {} is complete: {} points remain; run the shards again\n", over,
                     results.rungs, results.closed.survivors.back().size());
}

/// Collects the statistics of all points, while their runs are written to the tables.
void collect_points(const FoundSweep& found, const RunIndex& index, GrowingTables& tables,
                    SweepResults& results) {
  Diagnostics warnings;
  for_each_point(found.plan, index, [&](const PointResults& point) {
    tables.add(point);
    const std::vector<SweepRow> rows = rows_of(point);
    results.rows.insert(results.rows.end(), rows.begin(), rows.end());
    results.failed.insert(results.failed.end(), point.failed.begin(), point.failed.end());
    add_warnings(found.plan, point, warnings);
  });
  results.warnings = fewer(warnings.warnings());
}

}  // namespace

OpenSweep open_sweep(const std::string& suite, const std::string& out, const WorldOptions& world) {
  suggest_shared_file(suite);
  OpenSweep sweep;
  Suite loaded = load_suite(suite);
  set_world_options(world, loaded);
  sweep.plan = planned(loaded);
  sweep.suite = suite;
  sweep.folder = out.empty() ? "runs/sweep_" + folder_name(loaded.name) : out;
  sweep.means.methods = built_in_methods();
  sweep.means.read = [](const SuiteRecording& recording) {
    Diagnostics unheard;  // Warnings are reported once, by require_runnable().
    return read_recording(recording, unheard);
  };
  require_runnable(sweep.plan, sweep.means, sweep.diagnostics);
  const std::string text = read_text_file(suite, kMaxSuiteBytes);
  sweep.head = {program_version(), work_hash(text, loaded, {})};
  const std::string place = std::filesystem::absolute(suite).lexically_normal().string();
  claim_sweep_folder(sweep.folder, {sweep.head, place, text});
  return sweep;
}

Merged merge_sweep(const std::string& folder, bool with_page, bool as_json) {
  const FoundSweep found = found_sweep(folder);
  Diagnostics damaged;
  const RunIndex index = index_runs(all_logs(folder), found.source.head, damaged);
  print_warnings(damaged);
  Merged merged;
  SweepResults results;
  results.plan = found.plan;
  results.rungs = rung_seeds(found.plan).size();
  results.closed = read_closed_rungs(folder, found.source.head);
  while (close_rung(found.plan, index, results.closed)) merged.closed_a_rung = true;
  const std::vector<RunKey> planned_runs = runs_of(found.plan, results.closed);
  results.planned = planned_runs.size();
  results.missing = missing_of(planned_runs, index).size();

  StagedFolder staged(folder);
  GrowingTables tables(found.plan, staged, folder);
  collect_points(found, index, tables, results);
  tables.finish(results);
  staged.add("points.csv", sweep_points_to_csv(results));
  staged.add("results.json", sweep_to_json(results));
  if (with_page) stage_pages(results, staged);
  staged.commit({"sweep.html", "figures", kDatabase});
  if (merged.closed_a_rung) write_closed_rungs(folder, found.source.head, results.closed);

  merged.complete = results.complete();
  merged.exit_code = merged.complete && results.failed.empty() ? kExitOk : kExitIncomplete;
  if (!sqlite::is_built_in()) {
    fmt::print(stderr,
               "tagfield: warning: built without SQLite (libsqlite3-dev), so there is no "
               "results.sqlite\n");
  }
  if (as_json) {
    merged.json = sweep_to_json(results);
    return merged;
  }
  fmt::print("{}", sweep_to_text(results));
  print_failures(results, found, folder);
  fmt::print("{}", left_text(results, found, folder, merged.closed_a_rung));
  fmt::print("cost: {:.3g} core hours\n", index.cpu_s / 3600.0);
  fmt::print("{}: {}\n", with_page ? "page" : "folder",
             with_page ? folder + "/sweep.html" : folder);
  return merged;
}

int print_status(const std::string& folder, bool as_json) {
  const FoundSweep found = found_sweep(folder);
  Diagnostics damaged;
  const std::vector<std::string> logs = all_logs(folder);
  const RunIndex index = index_runs(logs, found.source.head, damaged);
  print_warnings(damaged);
  const ClosedRungs closed = read_closed_rungs(folder, found.source.head);
  const std::vector<RunKey> runs = runs_of(found.plan, closed);
  const std::size_t missing = missing_of(runs, index).size();
  const std::size_t done = runs.size() - missing;
  const auto failed = std::count_if(index.runs.begin(), index.runs.end(),
                                    [](const FoundRun& run) { return run.failed; });
  const std::size_t rungs = rung_seeds(found.plan).size();
  if (as_json) {
    const nlohmann::ordered_json json = {{"suite", found.plan.suite.name},
                                         {"runs", runs.size()},
                                         {"done", done},
                                         {"failed", failed},
                                         {"logs", logs.size()},
                                         {"rung", closed.survivors.size() + 1},
                                         {"rungs", rungs},
                                         {"core_hours", index.cpu_s / 3600.0}};
    fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    return kExitOk;
  }
  fmt::print("{}: {} of {} runs ({:.1f} %), {} failed, in {} logs\n", found.plan.suite.name, done,
             runs.size(), 100.0 * static_cast<double>(done) / static_cast<double>(runs.size()),
             failed, logs.size());
  if (rungs > 1) fmt::print("rung {} of {}\n", closed.survivors.size() + 1, rungs);
  const double each_s = index.runs.empty() ? 0.0 : index.cpu_s / static_cast<double>(done);
  fmt::print("cost: {:.3g} core hours so far", index.cpu_s / 3600.0);
  if (missing > 0 && done > 0) {
    fmt::print(", about {:.3g} to go", each_s * static_cast<double>(missing) / 3600.0);
  }
  fmt::print("\n");
  return kExitOk;
}

}  // namespace tagfield
