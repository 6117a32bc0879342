// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/internal/statistics.h"

#include <algorithm>
#include <cmath>

namespace tagfield {
namespace {

/// Values of a property, of the tags that have it.
std::vector<double> all_of(const BenchEntry& entry, std::optional<double> TagRecord::*property) {
  std::vector<double> values;
  for (const MethodRun& run : entry.runs) {
    for (const TagRecord& tag : run.tags) {
      if (tag.*property) values.push_back(*(tag.*property));
    }
  }
  return values;
}

void count_verdicts(const MethodRun& run, EntryStatistics& statistics) {
  for (const TagRecord& tag : run.tags) {
    ++statistics.tags;
    if (tag.verdict == Verdict::kLocated) ++statistics.located;
    if (tag.verdict == Verdict::kAmbiguous) ++statistics.ambiguous;
    if (tag.verdict == Verdict::kNotLocated) ++statistics.not_located;
    if (tag.error && *tag.error > kWrong_m) ++statistics.wrong;
    if (tag.false_claim) ++statistics.false_claims;
    if (tag.nearest_candidate && *tag.nearest_candidate <= kCandidateHits_m) {
      ++statistics.candidate_hits;
    }
  }
}

std::optional<BoundRatio> ratio_of(const BenchEntry& entry) {
  BoundRatio ratio;
  double errors = 0.0;
  double expected = 0.0;
  double squares = 0.0;
  double variances = 0.0;
  for (const MethodRun& run : entry.runs) {
    for (const TagRecord& tag : run.tags) {
      if (!(tag.error && tag.bound)) continue;
      ++ratio.count;
      errors += *tag.error;
      expected += tag.bound->mean_error_m;
      squares += *tag.error * *tag.error;
      variances += tag.bound->variance_m2;
    }
  }
  if (!(expected > 0.0 && variances > 0.0)) return std::nullopt;
  ratio.mean = errors / expected;
  ratio.rms = std::sqrt(squares / variances);
  return ratio;
}

std::optional<double> error_over_expected(const BenchEntry& entry) {
  double squares = 0.0;
  std::size_t count = 0;
  for (const MethodRun& run : entry.runs) {
    for (const TagRecord& tag : run.tags) {
      if (!(tag.error && tag.expected_error > 0.0)) continue;
      squares += std::pow(*tag.error / tag.expected_error, 2);
      ++count;
    }
  }
  if (count == 0) return std::nullopt;
  return std::sqrt(squares / static_cast<double>(count));
}

std::string bound_of(const std::vector<MethodRun>& runs) {
  std::string word;
  for (const MethodRun& run : runs) {
    const std::string own = to_string(run.bound);
    if (!word.empty() && word != own) return "mixed";
    word = own;
  }
  return word;
}

std::optional<double> median_time_ms(const std::vector<MethodRun>& runs) {
  std::vector<double> times;
  for (const MethodRun& run : runs) {
    if (run.tags_given == 0) continue;
    times.push_back(1e3 * run.seconds / static_cast<double>(run.tags_given));
  }
  if (times.empty()) return std::nullopt;
  std::sort(times.begin(), times.end());
  return quantile(times, 0.5);
}

}  // namespace

std::string to_string(BoundKind kind) { return kind == BoundKind::kJoint ? "joint" : "single"; }

EntryStatistics statistics_of(const BenchEntry& entry) {
  EntryStatistics result;
  result.runs = entry.runs.size();
  for (const MethodRun& run : entry.runs) {
    count_verdicts(run, result);
    ++result.methods_used[run.method];
  }
  result.error_m = statistics(all_of(entry, &TagRecord::error));
  result.error_3d_m = statistics(all_of(entry, &TagRecord::error_3d));
  result.aligned_error_m = statistics(all_of(entry, &TagRecord::aligned_error));
  result.nearest_candidate_m = statistics(all_of(entry, &TagRecord::nearest_candidate));
  result.error_over_expected = error_over_expected(entry);
  result.ratio = ratio_of(entry);
  result.bound = bound_of(entry.runs);
  result.nees = nees_summary(entry.runs);
  result.time_per_tag_ms = median_time_ms(entry.runs);
  return result;
}

std::vector<double> errors_of(const BenchEntry& entry) {
  std::vector<double> errors = all_of(entry, &TagRecord::error);
  std::sort(errors.begin(), errors.end());
  return errors;
}

std::vector<const BenchEntry*> entries_of(const Bench& bench, const std::string& condition) {
  std::vector<const BenchEntry*> entries;
  for (const BenchEntry& entry : bench.entries) {
    if (entry.condition == condition) entries.push_back(&entry);
  }
  return entries;
}

}  // namespace tagfield
