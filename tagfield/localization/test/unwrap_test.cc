// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_curves/unwrap.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "made_reads.h"
#include "tagfield/localization/phase_noise.h"

namespace tagfield {
namespace {

using namespace made;

const Noise kNoiseless{0.0, 0.0, 0.0, 0.0, 0.0};

/// Largest deviation of a segment's distances from the true ones, relative to its first read.
double worst_departure(const std::vector<PhaseSegment>& segments, const Eigen::Vector3d& p_WT) {
  double worst = 0.0;
  for (const PhaseSegment& segment : segments) {
    const double first = (p_WT - segment.samples[0].p_WA).norm();
    for (std::size_t i = 0; i < segment.samples.size(); ++i) {
      const double change = (p_WT - segment.samples[i].p_WA).norm() - first;
      worst = std::max(worst, std::abs(segment.distance_m[i] - change));
    }
  }
  return worst;
}

TEST(Unwrap, FollowsTheDistanceOverMetres) {
  Rng rng(1);
  const Path path = s_curve(20.0, 0.02);
  const Eigen::Vector3d p_WT(4.0, 2.0, 0.9);
  ReaderSetup setup;
  setup.range_m = 100.0;
  const auto samples = read_along(path, path, p_WT, kNoiseless, rng, setup);
  const auto segments = unwrap(samples, 0.8);
  ASSERT_EQ(segments.size(), 1u);
  EXPECT_EQ(segments[0].samples.size(), path.size());
  EXPECT_LT(worst_departure(segments, p_WT), 1e-6);
  const auto [low, high] =
      std::minmax_element(segments[0].distance_m.begin(), segments[0].distance_m.end());
  EXPECT_GT(*high - *low, 8.0);  // many cycles
}

TEST(Unwrap, BreaksJustWhereTheTravelIsTooLong) {
  rc::check([] {
    Rng rng(*rc::gen::arbitrary<std::uint64_t>());
    const double step = uniform(rng, 0.005, 0.05);
    const Path path = s_curve(6.0, step);
    const Eigen::Vector3d p_WT{uniform(rng, -1.0, 5.0), uniform(rng, -4.0, 4.0), 1.0};
    Noise noise = kNoiseless;
    noise.lost = uniform(rng, 0.0, 0.7);
    const auto samples = read_along(path, path, p_WT, noise, rng);
    if (samples.empty()) return;
    const auto segments = unwrap(samples, 0.8);
    // The second differences of a noiseless phase keep the limit at max_step: λ/4 · 0.8.
    const double limit = 0.8 * wavelength(865.7e6) / 4.0;
    std::size_t breaks = 0;
    for (std::size_t i = 1; i < samples.size(); ++i) {
      if ((samples[i].p_WA - samples[i - 1].p_WA).norm() > limit) ++breaks;
    }
    RC_ASSERT(segments.size() == breaks + 1);
    RC_ASSERT(worst_departure(segments, p_WT) < 1e-6);
  });
}

TEST(Unwrap, ANewCarrierStartsANewSegment) {
  Rng rng(2);
  const Path path = straight(1.0, 0.02);
  auto samples = read_along(path, {0.0, 2.0, 0.4}, kNoiseless, rng);
  for (std::size_t i = 20; i < samples.size(); ++i) samples[i].frequency_hz = 866.3e6;
  const auto segments = unwrap(samples, 0.8);
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_EQ(segments[0].samples.size(), 20u);
}

TEST(Unwrap, NothingGivesNothing) { EXPECT_TRUE(unwrap({}, 0.8).empty()); }

TEST(PhaseNoise, IsEstimatedThroughMotion) {
  for (const double sigma : {0.05, 0.1, 0.3, 0.5}) {
    Rng rng(3);
    const Path path = s_curve(22.0, 0.02);
    Noise noise;
    noise.phase_rad = sigma;
    const auto samples = read_along(path, {4.0, 2.0, 0.4}, noise, rng);
    EXPECT_NEAR(phase_noise(samples), sigma, 0.15 * sigma) << sigma;
  }
}

TEST(ExpectedSlips, AreAsManyDifferencesOfNoiseBeyondPi) {
  Rng rng(4);
  const Path path = s_curve(22.0, 0.02);
  const Eigen::Vector3d p_WT(4.0, 2.0, 0.4);
  constexpr double kSigma = 0.7;
  double expected = 0.0;
  int counted = 0;
  for (int i = 0; i < 200; ++i) {
    const auto clean = read_along(path, path, p_WT, kNoiseless, rng);
    auto noisy = clean;
    double before = 0.0;
    for (std::size_t k = 0; k < noisy.size(); ++k) {
      const double now = normal(rng, kSigma);
      noisy[k].phase_rad = wrap_to_two_pi(clean[k].phase_rad + now);
      if (k > 0 && std::abs(now - before) > kPi) ++counted;
      before = now;
    }
    expected += expected_slips({{"a", noisy}});
  }
  ASSERT_GT(counted, 200);
  // Four standard deviations of a Poisson distribution, plus the effect of the error of the noise
  // estimated by the median.
  EXPECT_NEAR(expected, counted, 4.0 * std::sqrt(counted) + 0.15 * counted);
  EXPECT_LT(expected_slips({{"a", read_along(path, p_WT, Noise{}, rng)}}), 1e-9);
}

TEST(StepLimit, ShrinksWithTheNoiseButNotToNothing) {
  EXPECT_DOUBLE_EQ(step_limit(0.0, 0.8), 0.8);
  EXPECT_NEAR(step_limit(0.3, 0.8), 1.0 - 2.5 * std::sqrt(2.0) * 0.3 / kPi, 1e-12);
  EXPECT_DOUBLE_EQ(step_limit(3.0, 0.8), 0.5);
  EXPECT_DOUBLE_EQ(step_limit(3.0, 0.2), 0.2);
}

}  // namespace
}  // namespace tagfield
