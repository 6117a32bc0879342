// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_curves/phase_following.h"

#include <Eigen/Core>
#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

/// Uncertainty of the expected phase [rad] above which whole turns are unreliable.
constexpr double kUnsure = kTwoPi / 6.5;
/// Rate at which the direction to the tag changes along the antenna's path. For a tag 1.7 m beside
/// the path, it turns by 0.6 rad over a metre; the second term is for nearer tags, whose direction
/// keeps turning to the same side.
constexpr double kTurning = 0.6;       // [1/m]
constexpr double kMoreTurning = 0.05;  // Variance [1/m].
constexpr double kMinNoise = 0.02;     // [rad]

/// Direction to the tag and error of the last phase, with their covariance. The error of the last
/// phase is part of the state because the next difference contains it.
struct Follower {
  Eigen::Vector4d state = Eigen::Vector4d::Zero();  ///< u, then the error of the last phase.
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
};

Follower start(double noise_rad) {
  Follower follower;
  // All directions are equally likely: a unit vector has variance 1/3 along each axis, 1/2 in the
  // plane.
  follower.covariance.diagonal() << 0.5, 0.5, 0.5, noise_rad * noise_rad;
  return follower;
}

/// Expected phase change over `step` [m], given the last measured phase.
struct Expected {
  double change = 0.0;
  double variance = 0.0;
  Eigen::RowVector4d H;
};

Expected expect(Follower& follower, const Eigen::Vector3d& step, double wavenumber,
                double noise_rad) {
  const double way = step.norm();
  follower.covariance.diagonal().head<3>().array() +=
      kTurning * kTurning * way * way + kMoreTurning * way;
  Expected expected;
  expected.H << -wavenumber * step.transpose(), -1.0;
  expected.change = expected.H.dot(follower.state);
  expected.variance = expected.H * follower.covariance * expected.H.transpose();
  expected.variance += noise_rad * noise_rad;
  return expected;
}

/// Updates with the measured change; afterwards, the state's last entry is the error of the new
/// phase.
void learn(Follower& follower, const Expected& expected, double innovation, double noise_rad) {
  // The new phase = expected + innovation, its error e' is the noise, which the innovation
  // contains: cov(innovation, e') = σ².
  const Eigen::Vector4d gain = follower.covariance * expected.H.transpose() / expected.variance;
  const Eigen::Matrix4d before = follower.covariance;
  const double noise = noise_rad * noise_rad;
  follower.state += gain * innovation;
  follower.covariance -= gain * expected.variance * gain.transpose();
  const double own_gain = noise / expected.variance;
  follower.state[3] = own_gain * innovation;
  const Eigen::Vector3d cross = -own_gain * (before * expected.H.transpose()).head<3>();
  follower.covariance.row(3).head<3>() = cross.transpose();
  follower.covariance.col(3).head<3>() = cross;
  follower.covariance(3, 3) = noise * (1.0 - own_gain);
}

void begin_segment(const PhaseSample& sample, std::vector<PhaseSegment>& segments) {
  segments.emplace_back();
  segments.back().samples.push_back(sample);
  segments.back().distance_m.push_back(0.0);
}

}  // namespace

std::vector<PhaseSegment> follow(const std::vector<PhaseSample>& samples, double noise_rad) {
  const double noise = std::max(noise_rad, kMinNoise);
  std::vector<PhaseSegment> segments;
  Follower follower;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const PhaseSample& sample = samples[i];
    if (i == 0 || samples[i - 1].frequency_hz != sample.frequency_hz) {
      begin_segment(sample, segments);
      follower = start(noise);
      continue;
    }
    const double wavenumber = 2.0 * kTwoPi / wavelength(sample.frequency_hz);
    const Expected expected =
        expect(follower, sample.p_WA - samples[i - 1].p_WA, wavenumber, noise);
    if (!(std::sqrt(expected.variance) < kUnsure)) {
      begin_segment(sample, segments);
      follower = start(noise);
      continue;
    }
    const double measured = sample.phase_rad - samples[i - 1].phase_rad;
    const double innovation = wrap_to_pi(measured - expected.change);
    learn(follower, expected, innovation, noise);
    PhaseSegment& segment = segments.back();
    segment.distance_m.push_back(segment.distance_m.back() +
                                 (expected.change + innovation) / wavenumber);
    segment.samples.push_back(sample);
  }
  return segments;
}

}  // namespace tagfield
