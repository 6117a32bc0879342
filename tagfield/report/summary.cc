// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/summary.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tagfield {

std::vector<double> all_errors(const Summary& summary) {
  std::vector<double> errors;
  for (const TagOutcome& outcome : summary.tags) {
    if (const auto error = error_of(outcome)) errors.push_back(*error);
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

double quantile(const std::vector<double>& rising, double fraction) {
  const double rank = fraction * static_cast<double>(rising.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, rising.size() - 1);
  return rising[below] + (rank - static_cast<double>(below)) * (rising[above] - rising[below]);
}

std::optional<double> error_of(const TagOutcome& outcome) {
  const TagEstimate& estimate = outcome.estimate;
  const bool located = estimate.verdict == Verdict::kLocated && !estimate.candidates.empty();
  if (!located || !outcome.truth_m || outcome.reference) return std::nullopt;
  return (estimate.candidates.front().p_WT - *outcome.truth_m).norm();
}

std::optional<ErrorStatistics> statistics(std::vector<double> errors_m) {
  if (errors_m.empty()) return std::nullopt;
  std::sort(errors_m.begin(), errors_m.end());
  ErrorStatistics result;
  result.count = errors_m.size();
  result.mean =
      std::accumulate(errors_m.begin(), errors_m.end(), 0.0) / static_cast<double>(errors_m.size());
  result.median = quantile(errors_m, 0.5);
  result.p95 = quantile(errors_m, 0.95);
  result.max = errors_m.back();
  result.min = errors_m.front();
  return result;
}

std::optional<double> position_rms(const std::vector<AntennaPose>& a,
                                   const std::vector<AntennaPose>& b) {
  std::map<std::string, Trajectory> of_b;
  for (const AntennaPose& pose : b) of_b[pose.antenna].push_back({pose.stamp, pose.X_WA});
  double sum = 0.0;
  double count = 0.0;
  for (const AntennaPose& pose : a) {
    const Trajectory& trajectory = of_b[pose.antenna];
    const auto other = trajectory.size() > 1 ? pose_at(trajectory, pose.stamp) : std::nullopt;
    if (!other) continue;
    sum += (pose.X_WA.translation - other->translation).head<2>().squaredNorm();
    count += 1.0;
  }
  if (count == 0.0) return std::nullopt;
  return std::sqrt(sum / count);
}

std::map<std::string, std::size_t> count_by_tag(const std::vector<TagRead>& reads) {
  std::map<std::string, std::size_t> counts;
  for (const TagRead& read : reads) ++counts[read.tag];
  return counts;
}

std::optional<ErrorStatistics> error_statistics(const Summary& summary) {
  return statistics(all_errors(summary));
}

std::string to_string(EffectSet set) {
  constexpr const char* kWords[] = {"none", "alone", "all_but_this", "all"};
  return kWords[static_cast<std::size_t>(set)];
}

std::size_t count(const Summary& summary, Verdict verdict) {
  const auto matches = [&](const TagOutcome& tag) {
    return !tag.reference && tag.estimate.verdict == verdict;
  };
  return static_cast<std::size_t>(std::count_if(summary.tags.begin(), summary.tags.end(), matches));
}

std::size_t count_to_locate(const Summary& summary) {
  return static_cast<std::size_t>(
      std::count_if(summary.tags.begin(), summary.tags.end(),
                    [](const TagOutcome& tag) { return !tag.reference; }));
}

std::size_t count_over(const Summary& summary, double limit_m) {
  const std::vector<double> errors = all_errors(summary);
  const auto over = [&](double error) { return error > limit_m; };
  return static_cast<std::size_t>(std::count_if(errors.begin(), errors.end(), over));
}

}  // namespace tagfield
