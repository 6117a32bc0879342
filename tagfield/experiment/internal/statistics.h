// SPDX-License-Identifier: Apache-2.0
/// @file
/// Statistics of one method in one condition.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/experiment/bench/bench.h"
#include "tagfield/experiment/internal/consistency.h"
#include "tagfield/report/summary.h"

namespace tagfield {

inline constexpr double kWrong_m = 0.3;          ///< A located tag with a larger error is wrong.
inline constexpr double kCandidateHits_m = 0.1;  ///< A candidate this close is right.

/// Errors as multiples of those of an efficient estimator, over the located tags that have a bound.
struct BoundRatio {
  std::size_t count = 0;
  double mean = 0.0;  ///< Σ|e| / Σ of the expected |e|.
  double rms = 0.0;   ///< √(Σe² / Σ of the variances).
};

struct EntryStatistics {
  std::size_t runs = 0;
  std::size_t tags = 0;  ///< Attempted: tags times runs.
  std::size_t located = 0;
  std::size_t ambiguous = 0;
  std::size_t not_located = 0;
  std::size_t wrong = 0;                               ///< Of the located.
  std::size_t false_claims = 0;                        ///< Of the located.
  std::optional<ErrorStatistics> error_m;              ///< Horizontal, of the located.
  std::optional<ErrorStatistics> error_3d_m;           ///< Of those whose height was estimated.
  std::optional<ErrorStatistics> aligned_error_m;      ///< If poses are estimated.
  std::optional<ErrorStatistics> nearest_candidate_m;  ///< Of the ambiguous.
  std::size_t candidate_hits = 0;  ///< Ambiguous ones with the right position among the candidates.
  /// Root mean square of error over expected error, of the located; 1 if the stated errors are
  /// right.
  std::optional<double> error_over_expected;
  std::optional<BoundRatio> ratio;
  std::string bound;  ///< "single", "joint", "mixed"; "" without runs.
  std::optional<NeesSummary> nees;
  std::map<std::string, std::size_t> methods_used;  ///< Number of runs by method.
  std::optional<double> time_per_tag_ms;            ///< Median over the runs.
};

EntryStatistics statistics_of(const BenchEntry& entry);

/// Horizontal errors of all located tags [m], ascending.
std::vector<double> errors_of(const BenchEntry& entry);

/// The entries of one condition.
std::vector<const BenchEntry*> entries_of(const Bench& bench, const std::string& condition);

}  // namespace tagfield
