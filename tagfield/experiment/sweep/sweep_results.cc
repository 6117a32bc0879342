// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/sweep/sweep_results.h"

#include <algorithm>
#include <cmath>

#include "tagfield/experiment/internal/statistics.h"

namespace tagfield {
namespace {

/// Sum and count of a run's errors.
struct ErrorSum {
  double sum = 0.0;
  double count = 0.0;
};

/// Standard error of a ratio of sums over independent runs (Cochran, Sampling Techniques, 1977, eq.
/// 6.13).
std::optional<double> mean_standard_error(const BenchEntry& entry) {
  std::vector<ErrorSum> sums;
  ErrorSum all;
  for (const MethodRun& run : entry.runs) {
    ErrorSum of_run;
    for (const TagRecord& tag : run.tags) {
      if (!tag.error) continue;
      of_run.sum += *tag.error;
      of_run.count += 1.0;
    }
    if (of_run.count == 0.0) continue;
    sums.push_back(of_run);
    all.sum += of_run.sum;
    all.count += of_run.count;
  }
  if (sums.size() < 2) return std::nullopt;
  const double mean = all.sum / all.count;
  double squares = 0.0;
  for (const ErrorSum& of_run : sums) {
    const double off = of_run.sum - mean * of_run.count;
    squares += off * off;
  }
  const auto runs = static_cast<double>(sums.size());
  return std::sqrt(squares * runs / (runs - 1.0)) / all.count;
}

}  // namespace

std::vector<SweepRow> rows_of(const PointResults& results) {
  std::vector<SweepRow> rows;
  for (const BenchEntry& entry : results.entries) {
    const EntryStatistics all = statistics_of(entry);
    SweepRow row;
    row.point = results.point;
    row.name = entry.name;
    row.method = entry.method;
    row.runs = all.runs;
    row.failed = results.failed.size();
    row.tags = all.tags;
    row.located = all.located;
    row.ambiguous = all.ambiguous;
    row.not_located = all.not_located;
    row.wrong = all.wrong;
    row.false_claims = all.false_claims;
    row.error_m = all.error_m;
    row.mean_standard_error_m = mean_standard_error(entry);
    row.error_over_expected = all.error_over_expected;
    if (all.ratio) row.ratio_to_bound = all.ratio->mean;
    if (all.nees) row.nees_per_dof = all.nees->mean / all.nees->expected;
    rows.push_back(std::move(row));
  }
  return rows;
}

std::size_t rung_of(const SweepResults& results, std::uint64_t point) {
  std::size_t rung = 0;
  for (const std::vector<std::uint64_t>& survivors : results.closed.survivors) {
    if (!std::binary_search(survivors.begin(), survivors.end(), point)) return rung;
    ++rung;
  }
  return rung;
}

std::optional<double> located_share(const SweepRow& row) {
  if (row.tags == 0) return std::nullopt;
  return static_cast<double>(row.located) / static_cast<double>(row.tags);
}

}  // namespace tagfield
