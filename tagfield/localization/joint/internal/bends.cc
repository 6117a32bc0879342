// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/internal/bends.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "tagfield/base/units.h"
#include "tagfield/localization/joint/internal/outlying.h"

namespace tagfield {
namespace {

using Eigen::Vector3d;

/// Poses of an antenna at its samples: positions from the samples, orientations from its track.
std::vector<RigidTransform> poses_of(const LocalizationProblem& problem, const std::string& antenna,
                                     const std::vector<PhaseSample>& series) {
  std::vector<RigidTransform> poses;
  poses.reserve(series.size());
  const auto track = problem.tracks.find(antenna);
  for (const PhaseSample& sample : series) {
    RigidTransform X_WA;
    if (track != problem.tracks.end()) X_WA = held_pose_at(track->second.X_WA, sample.stamp);
    X_WA.translation = sample.p_WA;
    poses.push_back(X_WA);
  }
  return poses;
}

/// Sum of the waves at a point.
struct Field {
  std::complex<double> all = 0.0;
  double direct = 0.0;      ///< Amplitude of the direct wave,
  double amplitudes = 0.0;  ///< and the sum of all.
  // Each wave times its direction at the tag and at the antenna.
  Eigen::Vector3cd at_tag = Eigen::Vector3cd::Zero();
  Eigen::Vector3cd at_antenna = Eigen::Vector3cd::Zero();
  /// 0 if the direct path is blocked.
  [[nodiscard]] double directness() const { return amplitudes > 0.0 ? direct / amplitudes : 0.0; }
};

Field field_at(const std::vector<TracedWave>& waves, const Vector3d& p, double wavenumber) {
  Field field;
  for (const TracedWave& wave : waves) {
    const Vector3d way = p - wave.source_W;
    const double r = std::max(way.norm(), 0.01);
    const std::complex<double> here = wave.amplitude / r * std::polar(1.0, -wavenumber * r);
    field.all += here;
    field.at_tag += here * way / r;
    field.at_antenna += here * wave.departure_W;
    field.amplitudes += std::abs(here);
    if (wave.direct) field.direct = std::abs(here);
  }
  return field;
}

Bend bend_at(const TracedReply& reply, const Vector3d& p_WA, const Vector3d& p, double carrier_hz) {
  const double k = kTwoPi / wavelength(carrier_hz);
  const Field forward = field_at(reply.forward, p, k);
  const Field backward = reply.backward.empty() ? forward : field_at(reply.backward, p, k);
  const double range = std::max((p - p_WA).norm(), 0.01);
  Bend bend;
  bend.directness = std::min(forward.directness(), backward.directness());
  if (!(bend.directness > 0.0)) return bend;
  const Vector3d straight = (p - p_WA) / range;
  bend.phase_rad = -std::arg(forward.all) - std::arg(backward.all) - 2.0 * k * range;
  bend.by_place =
      0.5 * (forward.at_tag / forward.all + backward.at_tag / backward.all).real() - straight;
  bend.by_antenna =
      straight -
      0.5 * (forward.at_antenna / forward.all + backward.at_antenna / backward.all).real();
  return bend;
}

/// Removes the marked samples; marks are in the order of the antennas and their samples.
void leave_out(const std::vector<bool>& marked, Straightened& straight) {
  std::size_t next = 0;
  for (auto& [antenna, series] : straight.samples) {
    std::vector<Bend>& bends = straight.bends.at(antenna);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < series.size(); ++i) {
      if (marked[next++]) continue;
      series[kept] = series[i];
      bends[kept++] = bends[i];
    }
    series.resize(kept);
    bends.resize(kept);
  }
}

}  // namespace

TracedReplies traced(const LocalizationProblem& problem, const std::string& tag,
                     const SamplesOfTag& samples, const Vector3d& p_WT) {
  std::map<std::string, TracedFrom> antennas;
  for (const auto& [antenna, series] : samples) {
    TracedFrom& from = antennas[antenna];
    from.X_WA = poses_of(problem, antenna, series);
    from.carriers_hz.reserve(series.size());
    for (const PhaseSample& sample : series) {
      from.carriers_hz.push_back(sample.frequency_hz / problem.multiple());
    }
  }
  return problem.trace(tag, p_WT, antennas);
}

Straightened straightened(const LocalizationProblem& problem, const Sight& sight,
                          const TracedReplies& replies, const Vector3d& p, double min_directness,
                          double noise_rad) {
  Straightened straight;
  std::vector<PhaseLeft> left;
  ChannelNumbers channels;
  for (const auto& [antenna, series] : sight.samples) {
    const std::vector<PhaseSample>& corrected = sight.corrected.at(antenna);
    const std::vector<TracedReply>& of_antenna = replies.at(antenna);
    for (std::size_t i = 0; i < series.size(); ++i) {
      PhaseSample sample = series[i];
      const Bend bend =
          bend_at(of_antenna[i], corrected[i].p_WA, p, sample.frequency_hz / problem.multiple());
      const bool is_used = bend.directness >= min_directness &&
                           std::max(bend.by_place.norm(), bend.by_antenna.norm()) < kSteepestBend;
      if (!is_used) continue;
      sample.phase_rad = wrap_to_two_pi(sample.phase_rad - problem.multiple() * bend.phase_rad);
      const double direct_rad =
          2.0 * kTwoPi / wavelength(sample.frequency_hz) * (p - corrected[i].p_WA).norm();
      left.push_back({channels.of(antenna, sample.frequency_hz), sample.phase_rad - direct_rad});
      straight.samples[antenna].push_back(sample);
      straight.bends[antenna].push_back(bend);
    }
  }
  leave_out(spread_of(left, noise_rad).outlying, straight);
  return straight;
}

}  // namespace tagfield
