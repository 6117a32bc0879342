// SPDX-License-Identifier: Apache-2.0
/// @file
/// The results of a sweep: statistics of each point and method.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/experiment/sweep/merge.h"
#include "tagfield/experiment/sweep/sweep_plan.h"
#include "tagfield/report/summary.h"

namespace tagfield {

/// One method at one point. Lengths in m; all tags of all runs have equal weight.
struct SweepRow {
  std::uint64_t point = 0;
  std::string name;    ///< Of the method, in the suite.
  std::string method;  ///< Its name in Tagfield.
  std::size_t runs = 0;
  std::size_t failed = 0;  ///< Runs without a result.
  std::size_t tags = 0;
  std::size_t located = 0;
  std::size_t ambiguous = 0;
  std::size_t not_located = 0;
  std::size_t wrong = 0;
  std::size_t false_claims = 0;
  std::optional<ErrorStatistics> error_m;  ///< Horizontal, of the located.
  /// Standard error of the mean error, from the scatter of the runs' means weighted by their
  /// numbers of located tags; none with fewer than two runs that located any.
  std::optional<double> mean_standard_error_m;
  std::optional<double> error_over_expected;
  std::optional<double> ratio_to_bound;  ///< Of mean errors.
  std::optional<double> nees_per_dof;
};

/// Rows of one point, one for each method.
std::vector<SweepRow> rows_of(const PointResults& results);

/// All results, except for the individual runs.
struct SweepResults {
  SweepPlan plan;
  std::vector<SweepRow> rows;  ///< By point, then by method.
  std::vector<FailedRun> failed;
  std::vector<std::string> warnings;
  std::size_t planned = 0;  ///< Runs of the rungs that are open.
  std::size_t missing = 0;  ///< Of the planned runs.
  std::size_t rungs = 1;    ///< Number of rungs,
  ClosedRungs closed;       ///< and the points kept after the closed ones.

  [[nodiscard]] bool complete() const {
    return missing == 0 && closed.survivors.size() + 1 == rungs;
  }
};

/// The last rung of a point, counted from 0.
std::size_t rung_of(const SweepResults& results, std::uint64_t point);

/// Share of the tags that were located; none if there were no tags.
std::optional<double> located_share(const SweepRow& row);

}  // namespace tagfield
