// SPDX-License-Identifier: Apache-2.0
/// @file
/// A sweep as tables, for CSV files and a database alike; docs/sweep.md lists every column.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tagfield/experiment/sweep/merge.h"
#include "tagfield/experiment/sweep/sweep_results.h"
#include "tagfield/files/table_rows.h"

namespace tagfield {

/// Takes a row.
using TakeRow = std::function<void(const std::vector<Cell>&)>;

/// `points`: point, rung, condition, then a column for each swept key, numbers as numbers.
TableForm points_form(const SweepPlan& plan);
std::vector<Cell> point_cells(const SweepResults& results, std::uint64_t point);

/// `results`: a row for each point and method.
TableForm results_form();
std::vector<Cell> result_cells(const SweepRow& row);

/// `runs`: a row for each point, method and seed.
TableForm runs_form();
void give_runs(const PointResults& results, const TakeRow& take);

/// `tags`: a row for each tag of each run by each method.
TableForm tags_form();
void give_tags(const PointResults& results, const TakeRow& take);

/// `failures`: runs that gave no result, why, and the option that runs them again.
TableForm failures_form();
std::vector<Cell> failure_cells(const FailedRun& run);

/// points.csv: `points` and `results` side by side.
std::string sweep_points_to_csv(const SweepResults& results);

/// results.json: what points.csv has, the failures, warnings, and whether that is all.
std::string sweep_to_json(const SweepResults& results);

}  // namespace tagfield
