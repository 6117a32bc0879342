// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/drift.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tagfield/base/median.h"
#include "tagfield/base/units.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/localization/map_error.h"

namespace tagfield {
namespace {

/// Error at a place due to a shift and a turn about another, `arm` before it.
Eigen::Matrix3d moved_by(const Eigen::Vector2d& arm) {
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  F(0, 2) = -arm.y();
  F(1, 2) = arm.x();
  return F;
}

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

/// Sum of the variances along each axis, and their number, over some of an antenna's reads.
struct DriftOfReads {
  double sum_m2 = 0.0;
  double count = 0.0;
};

DriftOfReads drift_of_reads(const std::vector<Drift>& drift,
                            const std::vector<PhaseSample>& series) {
  constexpr std::size_t kReads = 21;  // They are enough for an rms.
  DriftOfReads of;
  const double middle_s = to_seconds(series[series.size() / 2].stamp);
  const std::size_t count = std::min(kReads, series.size());
  for (std::size_t i = 0; i < count; ++i) {
    const PhaseSample& sample =
        series[i * (series.size() - 1) / std::max<std::size_t>(count - 1, 1)];
    const double time_s = to_seconds(sample.stamp);
    const auto [from_s, to_s] = std::minmax(middle_s, time_s);
    const Eigen::Matrix3d gained = drift_between(drift, from_s, to_s, sample.p_WA.head<2>());
    of.sum_m2 += 0.5 * gained.topLeftCorner<2, 2>().trace();
    of.count += 1.0;
  }
  return of;
}

/// Wavelength of the lowest carrier [m]; samples have `multiple` times the carriers of the reads.
double longest_wavelength(const LocalizationProblem& problem) {
  double lambda_m = 0.0;
  for (const auto& [tag, samples] : problem.samples) {
    for (const auto& [antenna, series] : samples) {
      if (series.empty()) continue;
      lambda_m = std::max(lambda_m, problem.multiple() * wavelength(series.front().frequency_hz));
    }
  }
  return lambda_m;
}

}  // namespace

Eigen::Matrix3d drift_between(const std::vector<Drift>& drift, double from_s, double to_s,
                              const Eigen::Vector2d& place) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  auto after = std::upper_bound(
      drift.begin(), drift.end(), from_s,
      [](double time_s, const Drift& entry) { return time_s < to_seconds(entry.stamp); });
  for (; after != drift.end(); ++after) {
    if (after == drift.begin()) continue;
    const double begin_s = to_seconds((after - 1)->stamp);
    if (begin_s >= to_s) break;
    const double end_s = to_seconds(after->stamp);
    const double share = (std::min(end_s, to_s) - std::max(begin_s, from_s)) / (end_s - begin_s);
    const Eigen::Matrix3d J = moved_by(place - after->origin_W);
    sum += share * (J * after->since_last * J.transpose());
  }
  return sum;
}

double drift_while_read(const LocalizationProblem& problem, const std::string& tag) {
  const auto samples = problem.samples.find(tag);
  if (samples == problem.samples.end()) return 0.0;
  DriftOfReads all;
  for (const auto& [antenna, series] : samples->second) {
    const auto drift = problem.drift.find(antenna);
    if (drift == problem.drift.end() || series.empty()) continue;
    const DriftOfReads of = drift_of_reads(drift->second, series);
    all.sum_m2 += of.sum_m2;
    all.count += of.count;
  }
  return all.count > 0.0 ? std::sqrt(all.sum_m2 / all.count) : 0.0;
}

double usual_drift_while_read(const LocalizationProblem& problem) {
  if (problem.drift.empty()) return 0.0;
  std::vector<double> drifts;
  for (const auto& [tag, samples] : problem.samples) {
    const double drift_m = drift_while_read(problem, tag);
    if (drift_m > 0.0) drifts.push_back(drift_m);
  }
  return median(std::move(drifts));
}

double usual_drift_in_wavelengths(const LocalizationProblem& problem) {
  const double drift_m = usual_drift_while_read(problem);
  return drift_m > 0.0 ? drift_m / longest_wavelength(problem) : 0.0;
}

void refuse_drifting(const LocalizationProblem& problem, LocalizationResult& result,
                     Diagnostics& diagnostics) {
  if (result.method == "joint" && !problem.reference_tags.empty()) return;
  const double drift_m = usual_drift_while_read(problem);
  if (usual_drift_in_wavelengths(problem) <= 0.5) return;
  const std::string why = fmt::format(
      "the wheels drift by {:.2f} m (standard deviation) while a tag is read, over half a "
      "wavelength, which reads can't correct",
      drift_m);
  bool any = false;
  for (TagEstimate& estimate : result.estimates) {
    if (problem.reference_tags.count(estimate.tag) > 0 || estimate.candidates.empty()) continue;
    any = any || estimate.verdict == Verdict::kLocated;
    if (drift_while_read(problem, estimate.tag) > 0.0) {
      estimate = not_located(std::move(estimate), why);
    }
  }
  if (any) {
    diagnostics.warn(
        "the wheels usually drift by over half a wavelength while a tag is read, which reads can't "
        "correct: no tag is located");
  }
}

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
