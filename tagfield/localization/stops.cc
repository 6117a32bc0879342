// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/stops.h"

#include <map>
#include <utility>

#include "tagfield/base/units.h"
#include "tagfield/fit/circular_mean.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

constexpr double kStop = 1e-3;  ///< [m]

/// The samples of one channel at one stop.
struct Gathered {
  PhaseSample first;
  CircularMean phase;
  double decibels = 0.0;
  double count = 0.0;
};

PhaseSample merged(const Gathered& of) {
  PhaseSample sample = of.first;
  if (of.count < 2.0) return sample;
  sample.phase_rad = wrap_to_two_pi(of.phase.value());
  sample.rssi_dbm = of.decibels / of.count;
  return sample;
}

std::vector<PhaseSample> with_stops_merged(const std::vector<PhaseSample>& series) {
  std::vector<PhaseSample> result;
  std::vector<Gathered> stop;  // One entry per channel, in order of appearance.
  std::map<double, std::size_t> channels;
  const auto finish = [&] {
    for (const Gathered& of : stop) result.push_back(merged(of));
    stop.clear();
    channels.clear();
  };
  for (const PhaseSample& sample : series) {
    if (!stop.empty() && (sample.p_WA - stop.front().first.p_WA).norm() > kStop) finish();
    const auto [found, is_new] = channels.emplace(sample.frequency_hz, stop.size());
    if (is_new) stop.push_back({sample, {}, 0.0, 0.0});
    Gathered& of = stop[found->second];
    of.phase.add(sample.phase_rad);
    of.decibels += sample.rssi_dbm;
    of.count += 1.0;
  }
  finish();
  result.shrink_to_fit();  // The samples of thousands of tags stay in memory for long.
  return result;
}

}  // namespace

void merge_stops(SamplesByTag& samples) {
  for (auto& [tag, of_tag] : samples) {
    for (auto& [antenna, series] : of_tag) {
      if (extent_of(series) >= kStillExtent) series = with_stops_merged(series);
    }
  }
}

}  // namespace tagfield
