// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/signal_strength/rssi_samples.h"

#include <cmath>

namespace tagfield {
namespace {

void add(const PhaseSample& sample, RssiBin& bin) {
  bin.reads += 1.0;
  bin.p_WA += (sample.p_WA - bin.p_WA) / bin.reads;
  bin.rssi_dbm += (sample.rssi_dbm - bin.rssi_dbm) / bin.reads;
}

}  // namespace

bool has_rssi(const PhaseSample& sample) {
  return std::isfinite(sample.rssi_dbm) && sample.rssi_dbm > kNoRssi;
}

std::map<std::string, std::vector<RssiBin>> rssi_along_paths(const SamplesOfTag& samples,
                                                             double length) {
  std::map<std::string, std::vector<RssiBin>> bins;
  for (const auto& [antenna, series] : samples) {
    Eigen::Vector3d first = Eigen::Vector3d::Zero();
    for (const PhaseSample& sample : series) {
      if (!has_rssi(sample)) continue;
      std::vector<RssiBin>& of_antenna = bins[antenna];
      if (of_antenna.empty() || (sample.p_WA - first).norm() > length) {
        of_antenna.push_back({sample.stamp, Eigen::Vector3d::Zero(), 0.0, 0.0});
        first = sample.p_WA;
      }
      add(sample, of_antenna.back());
    }
  }
  return bins;
}

RssiVector rssi_over_time(const SamplesOfTag& samples, double bin_s) {
  RssiVector means;
  RssiVector counts;
  for (const auto& [antenna, series] : samples) {
    for (const PhaseSample& sample : series) {
      if (!has_rssi(sample)) continue;
      const auto bin = static_cast<std::int64_t>(std::floor(to_seconds(sample.stamp) / bin_s));
      double& mean = means[{antenna, bin}];
      double& count = counts[{antenna, bin}];
      count += 1.0;
      mean += (sample.rssi_dbm - mean) / count;
    }
  }
  return means;
}

}  // namespace tagfield
