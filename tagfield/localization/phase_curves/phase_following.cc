// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_curves/phase_following.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "tagfield/base/median.h"
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

/// Expected phase change from one sample to another; nullopt if it is too vague, or the carrier is
/// another.
std::optional<Expected> expected_from(Follower& follower, const PhaseSample& before,
                                      const PhaseSample& sample, double noise_rad) {
  if (before.frequency_hz != sample.frequency_hz) return std::nullopt;
  const double wavenumber = 2.0 * kTwoPi / wavelength(sample.frequency_hz);
  const Expected expected = expect(follower, sample.p_WA - before.p_WA, wavenumber, noise_rad);
  if (!(std::sqrt(expected.variance) < kUnsure)) return std::nullopt;
  return expected;
}

/// Measured minus expected change [rad].
double innovation_of(const Expected& expected, const PhaseSample& before,
                     const PhaseSample& sample) {
  return wrap_to_pi(sample.phase_rad - before.phase_rad - expected.change);
}

/// Size of the innovation in standard deviations; nullopt without an expectation.
std::optional<double> deviations_of(Follower follower, const PhaseSample& before,
                                    const PhaseSample& sample, double noise_rad) {
  const auto expected = expected_from(follower, before, sample, noise_rad);
  if (!expected) return std::nullopt;
  return std::abs(innovation_of(*expected, before, sample)) / std::sqrt(expected->variance);
}

/// Number of samples from `i` on that are strays, given the last one followed.
std::size_t count_strays(const Follower& follower, const PhaseSample& last,
                         const std::vector<PhaseSample>& samples, std::size_t i, double noise_rad) {
  constexpr double kImplausible = 4.5, kPlausible = 3.0;
  constexpr std::size_t kMost = 3;
  if (deviations_of(follower, last, samples[i], noise_rad).value_or(0.0) < kImplausible) return 0;
  for (std::size_t n = 1; n <= kMost && i + n < samples.size(); ++n) {
    const auto off = deviations_of(follower, last, samples[i + n], noise_rad);
    if (off && *off < kPlausible) return n;
  }
  return 0;
}

/// Updates with the next sample and returns the unwrapped change of phase [rad]; nullopt, with a
/// new start, if there is no expectation.
std::optional<double> follow_on(const PhaseSample& before, const PhaseSample& sample,
                                double noise_rad, Follower& follower) {
  const auto expected = expected_from(follower, before, sample, noise_rad);
  if (!expected) {
    follower = start(noise_rad);
    return std::nullopt;
  }
  const double innovation = innovation_of(*expected, before, sample);
  learn(follower, *expected, innovation, noise_rad);
  return expected->change + innovation;
}

/// A wrong direction may explain every second or third read, so that the others seem arbitrary:
/// begins anew where that may be so.
std::vector<std::size_t> strays_forward(const std::vector<PhaseSample>& samples, double noise_rad) {
  constexpr int kFewest = 4;        ///< Reads followed before any counts as stray,
  constexpr int kFewestAmid = 2;    ///< and those between strays.
  std::vector<std::size_t> strays;  ///< But for the last ones.
  std::vector<std::size_t> last_strays;
  Follower follower = start(noise_rad);
  std::size_t last = 0;
  int followed = 0;
  int since = kFewestAmid;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    std::size_t count = 0;
    if (followed >= kFewest) {
      count = count_strays(follower, samples[last], samples, i, noise_rad);
    }
    const bool is_doubtful = count > 0 && since < kFewestAmid;
    if (is_doubtful) {
      last_strays.clear();
    } else if (count > 0) {
      strays.insert(strays.end(), last_strays.begin(), last_strays.end());
      last_strays.clear();
      for (std::size_t n = 0; n < count; ++n) last_strays.push_back(i + n);
      since = 0;
      i += count;
    }
    if (is_doubtful) follower = start(noise_rad);
    const bool follows =
        !is_doubtful && follow_on(samples[last], samples[i], noise_rad, follower).has_value();
    last = i;
    followed = follows ? followed + 1 : 0;
    since = follows ? since + 1 : kFewestAmid;
  }
  strays.insert(strays.end(), last_strays.begin(), last_strays.end());
  return strays;
}

/// Noise with which half of the samples are as expected: larger than that of the phases if the
/// antenna's steps are not exact.
double noise_with_steps(const std::vector<PhaseSample>& samples, double noise_rad) {
  constexpr std::size_t kFewest = 8;
  std::vector<double> deviations;
  Follower follower = start(noise_rad);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const auto off = deviations_of(follower, samples[i - 1], samples[i], noise_rad);
    if (off) deviations.push_back(*off);
    follow_on(samples[i - 1], samples[i], noise_rad, follower);
  }
  if (deviations.size() < kFewest) return noise_rad;
  return noise_rad * std::max(1.0, sigma_by_median(std::move(deviations)));
}

}  // namespace

std::vector<PhaseSample> by_channel(std::vector<PhaseSample> series) {
  std::stable_sort(series.begin(), series.end(), [](const PhaseSample& a, const PhaseSample& b) {
    return a.frequency_hz < b.frequency_hz;
  });
  return series;
}

std::vector<std::size_t> stray_samples(const std::vector<PhaseSample>& samples, double noise_rad) {
  constexpr int kRounds = 3;
  const double noise = noise_with_steps(samples, std::max(noise_rad, kMinNoise));
  std::vector<std::size_t> left(samples.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  std::set<std::size_t> strays;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<PhaseSample> series;
    series.reserve(left.size());
    for (const std::size_t i : left) series.push_back(samples[i]);
    const std::size_t before = strays.size();
    for (const std::size_t i : strays_forward(series, noise)) strays.insert(left[i]);
    std::reverse(series.begin(), series.end());
    for (const std::size_t i : strays_forward(series, noise)) {
      strays.insert(left[left.size() - 1 - i]);
    }
    if (strays.size() == before) break;
    left.erase(std::remove_if(left.begin(), left.end(),
                              [&](std::size_t i) { return strays.count(i) > 0; }),
               left.end());
  }
  return {strays.begin(), strays.end()};
}

std::vector<PhaseSegment> follow(const std::vector<PhaseSample>& samples, double noise_rad) {
  const double noise = std::max(noise_rad, kMinNoise);
  std::vector<PhaseSegment> segments;
  Follower follower = start(noise);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const PhaseSample& sample = samples[i];
    const auto change =
        i > 0 ? follow_on(samples[i - 1], sample, noise, follower) : std::optional<double>();
    if (!change) {
      begin_segment(sample, segments);
      continue;
    }
    const double wavenumber = 2.0 * kTwoPi / wavelength(sample.frequency_hz);
    PhaseSegment& segment = segments.back();
    segment.distance_m.push_back(segment.distance_m.back() + *change / wavenumber);
    segment.samples.push_back(sample);
  }
  return segments;
}

namespace {

/// Whether an innovation is as expected.
bool is_usual(const Expected& expected, double innovation) {
  constexpr double kUsual = 3.0;
  return std::abs(innovation) < kUsual * std::sqrt(expected.variance);
}

/// The change from one sample to the next if it is as expected; nullopt if not.
std::optional<double> usual_change(Follower& follower, const PhaseSample& one,
                                   const PhaseSample& next, double noise_rad) {
  const auto expected = expected_from(follower, one, next, noise_rad);
  if (!expected) return std::nullopt;
  const double innovation = innovation_of(*expected, one, next);
  if (!is_usual(*expected, innovation)) return std::nullopt;
  return expected->change + innovation;
}

/// The step from sample `from`, given those before, the last of which was a change of `before_rad`.
std::optional<FollowedStep> followed_step(Follower ahead, const std::vector<PhaseSample>& samples,
                                          std::size_t from, double before_rad, double noise_rad) {
  const PhaseSample& one = samples[from];
  const PhaseSample& next = samples[from + 1];
  const auto expected = expected_from(ahead, one, next, noise_rad);
  if (!expected) return std::nullopt;
  const auto after = usual_change(ahead, next, samples[from + 2], noise_rad);
  if (!after) return std::nullopt;
  FollowedStep step;
  step.from = from;
  step.off_rad = innovation_of(*expected, one, next);
  step.change_rad = expected->change + step.off_rad;
  step.sigma_rad = std::sqrt(expected->variance);
  step.before_rad = before_rad;
  step.after_rad = *after;
  return step;
}

}  // namespace

std::vector<FollowedStep> followed_steps(const std::vector<PhaseSample>& samples,
                                         double noise_rad) {
  const double noise = noise_with_steps(samples, std::max(noise_rad, kMinNoise));
  std::vector<FollowedStep> steps;
  Follower follower = start(noise);
  std::optional<double> before;
  for (std::size_t i = 0; i + 2 < samples.size(); ++i) {
    if (before) {
      const auto step = followed_step(follower, samples, i, *before, noise);
      if (step) steps.push_back(*step);
    }
    Follower ahead = follower;
    before = usual_change(ahead, samples[i], samples[i + 1], noise);
    follow_on(samples[i], samples[i + 1], noise, follower);
  }
  return steps;
}

}  // namespace tagfield
