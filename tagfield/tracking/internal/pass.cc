// SPDX-License-Identifier: Apache-2.0
#include "tagfield/tracking/internal/pass.h"

#include <algorithm>
#include <map>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

/// Velocity of the antenna between the neighbours of sample i [m/s]; 0 if it is stationary.
Eigen::Vector3d antenna_velocity(const std::vector<PhaseSample>& series, std::size_t i) {
  const PhaseSample& before = series[i > 0 ? i - 1 : i];
  const PhaseSample& after = series[std::min(i + 1, series.size() - 1)];
  const double time = to_seconds(after.stamp - before.stamp);
  if (time <= 0.0) return Eigen::Vector3d::Zero();
  return (after.p_WA - before.p_WA) / time;
}

/// All reads in time order; `t_s` is not set yet.
void gather(const LocalizationProblem& problem, const SamplesOfTag& samples, Pass& pass) {
  std::map<std::pair<std::size_t, double>, std::size_t> groups;
  for (const auto& [antenna, series] : samples) {
    const std::size_t index = pass.antennas.size();
    pass.antennas.push_back(antenna);
    const bool known = problem.offset_known.count(antenna) > 0;
    for (std::size_t i = 0; i < series.size(); ++i) {
      const PhaseSample& sample = series[i];
      const auto group = groups.emplace(std::pair(index, sample.frequency_hz), groups.size()).first;
      pass.reads.push_back({0.0, sample.stamp, sample.phase_rad,
                            2.0 * kTwoPi / wavelength(sample.frequency_hz), sample.p_WA,
                            antenna_velocity(series, i), index, group->second, known});
    }
  }
  pass.groups = groups.size();
  std::stable_sort(pass.reads.begin(), pass.reads.end(),
                   [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
}

/// Keeps the piece with the most reads.
void cut_at_gaps(double max_gap_s, Pass& pass) {
  const Duration longest = duration_from_seconds(max_gap_s);
  std::size_t best = 0;
  std::size_t best_size = 0;
  for (std::size_t begin = 0; begin < pass.reads.size();) {
    std::size_t end = begin + 1;
    while (end < pass.reads.size() &&
           pass.reads[end].stamp - pass.reads[end - 1].stamp <= longest) {
      ++end;
    }
    if (end - begin > best_size) {
      best = begin;
      best_size = end - begin;
    }
    begin = end;
  }
  pass.cut_off = pass.reads.size() - best_size;
  const auto at = [&](std::size_t i) {
    return pass.reads.begin() + static_cast<std::ptrdiff_t>(i);
  };
  pass.reads = std::vector<PassRead>(at(best), at(best + best_size));
}

HeightPrior height_prior(const LocalizationProblem& problem, const std::string& tag,
                         const TrackingOptions& options) {
  const bool known = problem.heights.of_all || problem.heights.of_tag.count(tag) > 0;
  return {plane_height(problem, tag),
          known ? options.height_sigma_m : options.unknown_height_sigma_m};
}

}  // namespace

Pass make_pass(const LocalizationProblem& problem, const std::string& tag,
               const TrackingOptions& options) {
  Pass pass;
  pass.tag = tag;
  pass.height = height_prior(problem, tag, options);
  const auto samples = problem.samples.find(tag);
  if (samples == problem.samples.end()) return pass;
  gather(problem, samples->second, pass);
  if (pass.reads.empty()) return pass;
  cut_at_gaps(options.max_gap_s, pass);
  const Time first = pass.reads.front().stamp;
  pass.origin = first + (pass.reads.back().stamp - first) / 2;
  for (PassRead& read : pass.reads) read.t_s = to_seconds(read.stamp - pass.origin);
  return pass;
}

double duration_of(const Pass& pass) {
  return pass.reads.empty() ? 0.0 : pass.reads.back().t_s - pass.reads.front().t_s;
}

Eigen::Vector3d middle_of_antennas(const Pass& pass) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const PassRead& read : pass.reads) sum += read.p_WA;
  return pass.reads.empty() ? sum : Eigen::Vector3d(sum / static_cast<double>(pass.reads.size()));
}

}  // namespace tagfield
