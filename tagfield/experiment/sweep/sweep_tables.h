// SPDX-License-Identifier: Apache-2.0
/// @file
/// A sweep as tables, for both CSV files and a database; docs/sweep.md lists every column.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tagfield/experiment/sweep/merge.h"
#include "tagfield/experiment/sweep/sweep_results.h"
#include "tagfield/files/table_rows.h"

namespace tagfield {

/// Receives a row.
using TakeRow = std::function<void(const std::vector<Cell>&)>;

/// `points`: point, rung, condition, then one column per swept key; numeric values are stored as
/// numbers.
TableForm points_form(const SweepPlan& plan);
std::vector<Cell> point_cells(const SweepResults& results, std::uint64_t point);

/// `results`: one row per point and method.
TableForm results_form();
std::vector<Cell> result_cells(const SweepRow& row);

/// `runs`: one row per point, method and seed.
TableForm runs_form();
void give_runs(const PointResults& results, const TakeRow& take);

/// `tags`: one row per tag of each run by each method.
TableForm tags_form();
void give_tags(const PointResults& results, const TakeRow& take);

/// `failures`: runs without a result, the reason, and the option that repeats them.
TableForm failures_form();
std::vector<Cell> failure_cells(const FailedRun& run);

/// points.csv: `points` and `results` side by side.
std::string sweep_points_to_csv(const SweepResults& results);

/// results.json: the contents of points.csv, the failures, warnings, and whether the sweep is
/// complete.
std::string sweep_to_json(const SweepResults& results);

}  // namespace tagfield
