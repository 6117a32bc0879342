// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/drift.h"

#include <algorithm>
#include <limits>

#include "tagfield/localization/map_error.h"

namespace tagfield {
namespace {

/// The last one until `stamp`, or the first.
const Drift& drift_at(const std::vector<Drift>& drift, Time stamp) {
  const auto after =
      std::upper_bound(drift.begin(), drift.end(), stamp,
                       [](Time time, const Drift& entry) { return time < entry.stamp; });
  return after == drift.begin() ? drift.front() : *(after - 1);
}

/// At the read from the nearest antenna; null if no antenna that drifts read the tag.
const Drift* drift_where_nearest(const LocalizationProblem& problem, const std::string& tag,
                                 const Eigen::Vector2d& p_WT) {
  const auto samples = problem.samples.find(tag);
  if (samples == problem.samples.end()) return nullptr;
  double nearest = std::numeric_limits<double>::infinity();
  const Drift* found = nullptr;
  for (const auto& [antenna, series] : samples->second) {
    const auto drift = problem.drift.find(antenna);
    if (drift == problem.drift.end()) continue;
    const PhaseSample* closest = nullptr;
    for (const PhaseSample& sample : series) {
      const double squared = (sample.p_WA.head<2>() - p_WT).squaredNorm();
      if (squared >= nearest) continue;
      nearest = squared;
      closest = &sample;
    }
    if (closest != nullptr) found = &drift_at(drift->second, closest->stamp);
  }
  return found;
}

}  // namespace

void add_drift(const LocalizationProblem& problem, LocalizationResult& result) {
  if (problem.drift.empty() || !result.corrected_poses.empty()) return;
  const auto of_drift = [&](const std::string& tag, const Eigen::Vector2d& p_WT) {
    const Drift* const drift = drift_where_nearest(problem, tag, p_WT);
    if (drift == nullptr) return Eigen::Matrix2d(Eigen::Matrix2d::Zero());
    return shift_at(drift->origin_W, drift->since_start, p_WT);
  };
  add_shifts(problem, "the drift of the wheels, which joint estimates,", of_drift, result);
}

}  // namespace tagfield
