// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tags moving past stationary antennas, generated for this room's tests without any simulator
/// code: eq. (3) of the paper with normal phase noise.
#pragma once

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "tagfield/base/units.h"
#include "tagfield/localization/problem.h"

namespace tagfield::made {

using Rng = std::mt19937_64;

inline double normal(Rng& rng, double sigma) {
  return sigma > 0.0 ? std::normal_distribution<double>(0.0, sigma)(rng) : 0.0;
}
inline double uniform(Rng& rng, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(rng);
}

struct Gate {
  std::vector<Eigen::Vector3d> antennas{{-0.5, 1.5, 1.2}, {0.5, 1.5, 1.2}};
  double rate_hz = 15.0;
  double range_m = 4.0;
  double noise_rad = 0.1;
  double lost = 0.0;
  double phase_step_rad = 0.0;
  std::vector<double> channels_hz{865.7e6};
  double dwell_s = 0.4;
  bool pi_ambiguity = false;
};

using Motion = std::function<Eigen::Vector3d(double)>;

inline std::string antenna_name(std::size_t i) { return "gate" + std::to_string(i + 1); }

/// Offset of an antenna and channel.
inline double offset(std::size_t antenna, std::size_t channel) {
  return std::fmod(1.3 + 2.1 * static_cast<double>(antenna) + 4.7 * static_cast<double>(channel),
                   kTwoPi);
}

/// Reads of `tag` while it is in range, between two times [s].
inline void read_motion(const Gate& gate, const std::string& tag, const Motion& motion,
                        double begin_s, double end_s, Rng& rng, std::vector<TagRead>& reads) {
  for (std::size_t a = 0; a < gate.antennas.size(); ++a) {
    const auto first = static_cast<int>(std::ceil(begin_s * gate.rate_hz));
    for (int i = first; i / gate.rate_hz < end_s; ++i) {
      const double t = i / gate.rate_hz;
      const double r = (motion(t) - gate.antennas[a]).norm();
      if (r > gate.range_m || uniform(rng, 0.0, 1.0) < gate.lost) continue;
      const auto visit = static_cast<std::size_t>((t + 1000.0) / gate.dwell_s);
      const std::size_t channel = (visit * 7) % gate.channels_hz.size();
      const double frequency = gate.channels_hz[channel];
      double phase = 2.0 * kTwoPi / wavelength(frequency) * r + offset(a, channel) +
                     normal(rng, gate.noise_rad);
      if (gate.pi_ambiguity && uniform(rng, 0.0, 1.0) < 0.5) phase += kPi;
      if (gate.phase_step_rad > 0.0) {
        phase = std::round(phase / gate.phase_step_rad) * gate.phase_step_rad;
      }
      reads.push_back({time_from_seconds(100.0) + duration_from_seconds(t), "reader",
                       antenna_name(a), tag, frequency, wrap_to_two_pi(phase), -50.0});
    }
  }
}

inline std::vector<AntennaPose> poses_of(const Gate& gate) {
  std::vector<AntennaPose> poses;
  for (std::size_t a = 0; a < gate.antennas.size(); ++a) {
    poses.push_back({Time{}, antenna_name(a), from_translation(gate.antennas[a])});
  }
  return poses;
}

inline LocalizationProblem problem_of(const Gate& gate, const std::vector<TagRead>& reads,
                                      double height_m) {
  KnownBeforehand known;
  known.heights.of_all = height_m;
  known.pi_ambiguity = gate.pi_ambiguity;
  Diagnostics diagnostics;
  return make_problem(reads, poses_of(gate), known, diagnostics);
}

inline double seconds_of(Time stamp) { return to_seconds(stamp) - 100.0; }

/// p + v t.
inline Motion straight(const Eigen::Vector3d& p, const Eigen::Vector3d& v) {
  return [p, v](double t) -> Eigen::Vector3d { return p + t * v; };
}

}  // namespace tagfield::made
