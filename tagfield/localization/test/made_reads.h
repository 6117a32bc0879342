// SPDX-License-Identifier: Apache-2.0
/// @file
/// Synthetic reads for the tests of this module, made without any code of the simulator: eq. (3) of
/// the paper with normal phase noise, a perturbed range, and paths of a few shapes.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tagfield/base/units.h"
#include "tagfield/localization/problem.h"

namespace tagfield::made {

using Rng = std::mt19937_64;
using Path = std::vector<Eigen::Vector3d>;

inline double normal(Rng& rng, double sigma) {
  return sigma > 0.0 ? std::normal_distribution<double>(0.0, sigma)(rng) : 0.0;
}
inline double uniform(Rng& rng, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(rng);
}

/// A path that follows its heading [rad] as a function of the arc length [m], in steps of `step`.
template <typename Heading>
Path follow(double length, double step, const Heading& heading, double z = 0.4) {
  Path path{{0.0, 0.0, z}};
  for (double s = 0.0; s < length; s += step) {
    const double angle = heading(s + step / 2.0);
    path.push_back(path.back() + step * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0));
  }
  return path;
}

inline Path s_curve(double length, double step) {
  return follow(length, step, [](double s) { return 1.1 * std::sin(kTwoPi * s / 11.0); });
}
inline Path loop(double length, double step) {
  return follow(length, step, [=](double s) { return kTwoPi * s / length; });
}
inline Path straight(double length, double step, double heading = 0.0) {
  return follow(length, step, [=](double) { return heading; });
}
/// Straight, a quarter turn of radius 0.5 m, straight.
inline Path l_turn(double first, double second, double step) {
  const double arc = 0.25 * kPi;
  return follow(first + arc + second, step,
                [=](double s) { return std::clamp((s - first) / 0.5, 0.0, kPi / 2.0); });
}
/// Around a rectangle of sides `a` and `b` with corners of radius 0.5 m, once or more.
inline Path rectangle(double a, double b, double length, double step) {
  const double arc = 0.25 * kPi;
  const double half = a + b + 2.0 * arc;
  return follow(length, step, [=](double s) {
    const double turns = std::floor(s / half) * kPi;
    const double u = std::fmod(s, half);
    const double first = std::clamp((u - a) / 0.5, 0.0, kPi / 2.0);
    return turns + first + std::clamp((u - a - arc - b) / 0.5, 0.0, kPi / 2.0);
  });
}

/// Down one aisle, around, back up the next.
inline Path aisles(double step) {
  return follow(22.0, step, [](double s) {
    return std::clamp((s - 9.0) / 1.2, 0.0, kPi) + 0.15 * std::sin(s);
  });
}

struct Noise {
  double phase_rad = 0.1;
  double range_sigma = 0.05;
  double lost = 0.0;       ///< Share of the reads lost at random.
  double pose_m = 0.0;     ///< Ornstein-Uhlenbeck error of the believed pose, per axis.
  double pose_time = 5.0;  ///< Its time constant [s]; 0: independent from read to read.
};

/// The path as believed by the reader.
inline Path believed(const Path& path, const Noise& noise, double rate_hz, Rng& rng) {
  Path beliefs = path;
  Eigen::Vector3d error{normal(rng, noise.pose_m), normal(rng, noise.pose_m), 0.0};
  const double keep = noise.pose_time > 0.0 ? std::exp(-1.0 / (rate_hz * noise.pose_time)) : 0.0;
  for (Eigen::Vector3d& p : beliefs) {
    p += error;
    const double fresh = noise.pose_m * std::sqrt(1.0 - keep * keep);
    error = keep * error + Eigen::Vector3d{normal(rng, fresh), normal(rng, fresh), 0.0};
  }
  return beliefs;
}

struct ReaderSetup {
  double frequency_hz = 865.7e6;
  double rate_hz = 15.0;
  double range_m = 7.0;
  double start_s = 1.7e9;
};

/// Samples of a tag at `p_WT` + `velocity` t.
inline std::vector<PhaseSample> read_along(const Path& path, const Path& beliefs,
                                           const Eigen::Vector3d& p_WT, const Noise& noise,
                                           Rng& rng, const ReaderSetup& setup = {},
                                           const Eigen::Vector3d& velocity = {0.0, 0.0, 0.0}) {
  const double offset = uniform(rng, 0.0, kTwoPi);
  const double lambda = wavelength(setup.frequency_hz);
  std::vector<PhaseSample> samples;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double time = static_cast<double>(i) / setup.rate_hz;
    const double r = (p_WT + time * velocity - path[i]).norm();
    const double reach = setup.range_m * std::abs(1.0 + normal(rng, noise.range_sigma));
    const double phase = kTwoPi / lambda * 2.0 * r + offset + normal(rng, noise.phase_rad);
    if (r > reach || uniform(rng, 0.0, 1.0) < noise.lost) continue;
    samples.push_back({time_from_seconds(setup.start_s) + duration_from_seconds(time),
                       wrap_to_two_pi(phase), setup.frequency_hz, beliefs[i]});
  }
  return samples;
}

inline std::vector<PhaseSample> read_along(const Path& path, const Eigen::Vector3d& p_WT,
                                           const Noise& noise, Rng& rng) {
  return read_along(path, believed(path, noise, 15.0, rng), p_WT, noise, rng);
}

/// A position `away` [m] to the side of a random point of the path, at height z.
inline Eigen::Vector3d beside(const Path& path, double away, double z, Rng& rng) {
  const auto last = static_cast<double>(path.size() - 2);
  const auto i = static_cast<std::size_t>(uniform(rng, 0.0, last));
  const Eigen::Vector3d along = (path[i + 1] - path[i]).normalized();
  const double side = uniform(rng, 0.0, 1.0) < 0.5 ? -1.0 : 1.0;
  Eigen::Vector3d p = path[i] + side * away * Eigen::Vector3d(-along.y(), along.x(), 0.0);
  p.z() = z;
  return p;
}

}  // namespace tagfield::made
