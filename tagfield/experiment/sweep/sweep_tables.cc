// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/sweep/sweep_tables.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "tagfield/base/number.h"

namespace tagfield {
namespace {

/// Seeds can exceed the range of a database's integers.
Cell whole_cell(std::uint64_t number) {
  if (number > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
    return Cell(std::to_string(number));
  }
  return Cell(static_cast<std::int64_t>(number));
}

/// A numeric cell if the value is a number.
Cell setting_cell(const std::string& value) {
  if (value.empty()) return Cell();
  if (const auto number = parse_number(value)) return Cell(*number);
  return Cell(value);
}

void append_cells(const std::vector<Cell>& more, std::vector<Cell>& cells) {
  cells.insert(cells.end(), more.begin(), more.end());
}

std::size_t count_of(const MethodRun& run, Verdict verdict) {
  std::size_t count = 0;
  for (const TagRecord& tag : run.tags) count += tag.verdict == verdict ? 1 : 0;
  return count;
}

std::optional<double> mean_error_of(const MethodRun& run) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const TagRecord& tag : run.tags) {
    if (!tag.error) continue;
    sum += *tag.error;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

void append_place(const std::optional<Eigen::Vector3d>& p, std::vector<Cell>& cells) {
  for (Eigen::Index i = 0; i < 3; ++i) cells.push_back(p ? Cell((*p)[i]) : Cell());
}

/// Without the first column of `results`, which repeats one of `points`.
std::vector<Cell> without_first(const std::vector<Cell>& cells) {
  return {cells.begin() + 1, cells.end()};
}

nlohmann::ordered_json json_of_cell(const Cell& cell) {
  switch (cell.kind) {
    case Cell::Kind::kWhole:
      return cell.whole;
    case Cell::Kind::kNumber:
      if (!std::isfinite(cell.number)) break;
      return cell.number;
    case Cell::Kind::kText:
      return cell.text;
    case Cell::Kind::kUnknown:
      break;
  }
  return nullptr;
}

nlohmann::ordered_json object_of(const TableForm& form, const std::vector<Cell>& cells) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    json[form.columns[i]] = json_of_cell(cells[i]);
  }
  return json;
}

TableForm joined_form(const SweepPlan& plan) {
  TableForm form = points_form(plan);
  const TableForm more = results_form();
  form.columns.insert(form.columns.end(), more.columns.begin() + 1, more.columns.end());
  return form;
}

std::vector<Cell> joined_cells(const SweepResults& results, const SweepRow& row) {
  std::vector<Cell> cells = point_cells(results, row.point);
  append_cells(without_first(result_cells(row)), cells);
  return cells;
}

}  // namespace

TableForm points_form(const SweepPlan& plan) {
  TableForm form{"points", {"point", "rung", "condition"}};
  form.columns.insert(form.columns.end(), plan.keys.begin(), plan.keys.end());
  return form;
}

std::vector<Cell> point_cells(const SweepResults& results, std::uint64_t point) {
  const SweepPoint& of = results.plan.points[point];
  std::vector<Cell> cells = {whole_cell(point), whole_cell(rung_of(results, point) + 1),
                             Cell(results.plan.suite.conditions[of.condition].name)};
  for (const std::string& key : results.plan.keys) cells.push_back(setting_cell(value_at(of, key)));
  return cells;
}

TableForm results_form() {
  return {"results",
          {"point", "name", "method", "runs", "failed", "tags", "located", "ambiguous",
           "not_located", "wrong", "false_claims", "mean_m", "mean_standard_error_m", "median_m",
           "p95_m", "max_m", "error_over_expected", "ratio_mean", "nees_per_dof"}};
}

std::vector<Cell> result_cells(const SweepRow& row) {
  std::vector<Cell> cells = {whole_cell(row.point), Cell(row.name), Cell(row.method)};
  for (const std::size_t count : {row.runs, row.failed, row.tags, row.located, row.ambiguous,
                                  row.not_located, row.wrong, row.false_claims}) {
    cells.push_back(whole_cell(count));
  }
  const auto error = [&](double ErrorStatistics::*of) -> std::optional<double> {
    if (!row.error_m) return std::nullopt;
    return (*row.error_m).*of;
  };
  for (const std::optional<double>& number :
       {error(&ErrorStatistics::mean), row.mean_standard_error_m, error(&ErrorStatistics::median),
        error(&ErrorStatistics::p95), error(&ErrorStatistics::max), row.error_over_expected,
        row.ratio_to_bound, row.nees_per_dof}) {
    cells.emplace_back(number);
  }
  return cells;
}

TableForm runs_form() {
  return {
      "runs",
      {"point", "name", "seed", "method", "tags", "located", "ambiguous", "not_located", "mean_m"}};
}

void give_runs(const PointResults& results, const TakeRow& take) {
  for (const BenchEntry& entry : results.entries) {
    for (const MethodRun& run : entry.runs) {
      take({whole_cell(results.point), Cell(entry.name), whole_cell(run.seed), Cell(run.method),
            whole_cell(run.tags.size()), whole_cell(count_of(run, Verdict::kLocated)),
            whole_cell(count_of(run, Verdict::kAmbiguous)),
            whole_cell(count_of(run, Verdict::kNotLocated)), Cell(mean_error_of(run))});
    }
  }
}

TableForm tags_form() {
  return {
      "tags",
      {"point", "name", "seed", "tag", "verdict", "reason", "reads", "error_m", "expected_error_m",
       "false_claim", "truth_x_m", "truth_y_m", "truth_z_m", "x_m", "y_m", "z_m"}};
}

void give_tags(const PointResults& results, const TakeRow& take) {
  for (const BenchEntry& entry : results.entries) {
    for (const MethodRun& run : entry.runs) {
      for (const TagRecord& tag : run.tags) {
        const bool placed = tag.verdict != Verdict::kNotLocated;
        std::vector<Cell> cells = {whole_cell(results.point),
                                   Cell(entry.name),
                                   whole_cell(run.seed),
                                   Cell(tag.tag),
                                   Cell(to_string(tag.verdict)),
                                   Cell(tag.reason),
                                   whole_cell(tag.reads),
                                   Cell(tag.error),
                                   placed ? Cell(tag.expected_error) : Cell(),
                                   whole_cell(tag.false_claim ? 1 : 0)};
        append_place(tag.truth, cells);
        append_place(tag.estimate, cells);
        take(cells);
      }
    }
  }
}

TableForm failures_form() { return {"failures", {"point", "seed", "reason", "again"}}; }

std::vector<Cell> failure_cells(const FailedRun& run) {
  return {whole_cell(run.key.point), whole_cell(run.key.seed), Cell(run.reason),
          Cell("--again " + to_string(run.key))};
}

std::string sweep_points_to_csv(const SweepResults& results) {
  std::string csv = csv_header(joined_form(results.plan));
  for (const SweepRow& row : results.rows) csv += csv_row(joined_cells(results, row));
  return csv;
}

std::string sweep_to_json(const SweepResults& results) {
  nlohmann::ordered_json json = {
      {"suite", results.plan.suite.name},
      {"description", results.plan.suite.description},
      {"complete", results.complete()},
      {"keys", results.plan.keys},
      {"runs_planned", results.planned},
      {"runs_missing", results.missing},
      {"rungs", results.rungs},
      {"rungs_over", results.complete() ? results.rungs : results.closed.survivors.size()},
      {"rows", nlohmann::ordered_json::array()},
      {"failures", nlohmann::ordered_json::array()},
      {"warnings", results.warnings}};
  const TableForm form = joined_form(results.plan);
  for (const SweepRow& row : results.rows) {
    json["rows"].push_back(object_of(form, joined_cells(results, row)));
  }
  for (const FailedRun& run : results.failed) {
    json["failures"].push_back(
        {{"point", run.key.point}, {"seed", run.key.seed}, {"reason", run.reason}});
  }
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace tagfield
