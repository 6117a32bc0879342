// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/fixed/fixed_reads.h"

#include "tagfield/localization/judgement.h"
#include "tagfield/localization/signal_strength/rssi_samples.h"

namespace tagfield {
namespace {

void add(const PhaseSample& sample, bool has_phases, FixedReads& reads) {
  reads.p_WA = sample.p_WA;
  if (has_rssi(sample)) {
    reads.strengths += 1.0;
    reads.rssi_dbm += (sample.rssi_dbm - reads.rssi_dbm) / reads.strengths;
  }
  if (!has_phases) return;
  ChannelPhase& channel = reads.channels[sample.frequency_hz];
  channel.reads += 1.0;
  channel.mean += (std::polar(1.0, sample.phase_rad) - channel.mean) / channel.reads;
}

Eigen::Vector3d boresight_of(const LocalizationProblem& problem, const std::string& antenna) {
  const auto track = problem.tracks.find(antenna);
  if (track == problem.tracks.end() || track->second.X_WA.empty()) return Eigen::Vector3d::UnitX();
  return track->second.X_WA.front().X_WB.rotation * Eigen::Vector3d::UnitX();
}

}  // namespace

std::vector<FixedReads> fixed_reads(const LocalizationProblem& problem,
                                    const SamplesOfTag& samples) {
  std::vector<FixedReads> all;
  for (const auto& [antenna, series] : samples) {
    if (series.empty() || extent_of(series) >= kStillExtent) continue;
    FixedReads reads;
    reads.antenna = antenna;
    reads.boresight_W = boresight_of(problem, antenna);
    for (const PhaseSample& sample : series) add(sample, problem.has_phases, reads);
    all.push_back(std::move(reads));
  }
  return all;
}

}  // namespace tagfield
