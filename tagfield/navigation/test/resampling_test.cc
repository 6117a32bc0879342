// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/resampling.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace tagfield {
namespace {

std::vector<double> random_log_weights(std::size_t count, std::mt19937& generator) {
  std::vector<double> log_weights(count);
  for (double& each : log_weights) each = uniform_draw(generator, -304.0, -300.0);
  return log_weights;
}

TEST(Resampling, SharesAreTheWeightsOverTheirSum) {
  const std::vector<double> shares =
      shares_of({std::log(1.0) - 1000.0, std::log(2.0) - 1000.0, std::log(5.0) - 1000.0});
  EXPECT_NEAR(shares[0], 0.125, 1e-12);
  EXPECT_NEAR(shares[1], 0.25, 1e-12);
  EXPECT_NEAR(shares[2], 0.625, 1e-12);
}

TEST(Resampling, UniformDrawsFillTheirRange) {
  std::mt19937 generator(1);
  constexpr int kDraws = 100000;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double draw = uniform_draw(generator, -1.0, 3.0);
    ASSERT_GE(draw, -1.0);
    ASSERT_LE(draw, 3.0);
    sum += draw;
    squares += draw * draw;
  }
  // Mean 1, variance 4²/12: within five standard errors for the mean and slightly more for the
  // variance.
  const double mean = sum / kDraws;
  EXPECT_NEAR(mean, 1.0, 5.0 * std::sqrt(16.0 / 12.0 / kDraws));
  EXPECT_NEAR(squares / kDraws - mean * mean, 16.0 / 12.0, 0.02);
}

RC_GTEST_PROP(Resampling, SystematicTakesEachAsOftenAsItsShareSays, (std::uint32_t seed)) {
  std::mt19937 generator(seed);
  const auto count = *rc::gen::inRange<std::size_t>(1, 60);
  const std::vector<double> log_weights = random_log_weights(count, generator);
  const std::vector<double> shares = shares_of(log_weights);
  const std::vector<std::size_t> chosen = systematic_resampling(log_weights, generator);
  RC_ASSERT(chosen.size() == count);
  RC_ASSERT(std::is_sorted(chosen.begin(), chosen.end()));
  for (std::size_t i = 0; i < count; ++i) {
    const auto times = static_cast<double>(std::count(chosen.begin(), chosen.end(), i));
    const double expected = shares[i] * static_cast<double>(count);
    RC_ASSERT(times > expected - 1.0 - 1e-9);
    RC_ASSERT(times < expected + 1.0 + 1e-9);
  }
}

TEST(Resampling, SystematicDrawsAreUnbiased) {
  std::mt19937 generator(2);
  const std::vector<double> log_weights = {std::log(0.05), std::log(0.25), std::log(0.7)};
  constexpr int kTimes = 40000;
  std::vector<int> times(3);
  for (int i = 0; i < kTimes; ++i) {
    for (const std::size_t chosen : systematic_resampling(log_weights, generator)) ++times[chosen];
  }
  // A draw's count is one of two adjacent integers, so its variance is at most 1/4.
  const double most = 5.0 * std::sqrt(0.25 * kTimes);
  EXPECT_NEAR(times[0], 3.0 * 0.05 * kTimes, most);
  EXPECT_NEAR(times[1], 3.0 * 0.25 * kTimes, most);
  EXPECT_NEAR(times[2], 3.0 * 0.7 * kTimes, most);
}

/// Largest distance between the distribution of draws and that of the weights.
double kolmogorov_distance(const std::vector<double>& shares, const WeightedDraw& drawn, int draws,
                           std::mt19937& generator) {
  std::vector<int> times(shares.size());
  for (int i = 0; i < draws; ++i) ++times[drawn(generator)];
  double most = 0.0;
  double expected = 0.0;
  double found = 0.0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    expected += shares[i];
    found += times[i] / static_cast<double>(draws);
    most = std::max(most, std::abs(found - expected));
  }
  return most;
}

TEST(Resampling, DrawsFollowTheWeights) {
  std::mt19937 generator(3);
  for (const std::size_t count : {1U, 7U, 500U, 3000U}) {
    const std::vector<double> log_weights = random_log_weights(count, generator);
    const std::vector<double> shares = shares_of(log_weights);
    constexpr int kDraws = 200000;
    // Kolmogorov-Smirnov limit at 99.9 %, plus the shift that the table of starts may cause.
    EXPECT_LT(kolmogorov_distance(shares, WeightedDraw(log_weights), kDraws, generator),
              1.95 / std::sqrt(kDraws) + *std::max_element(shares.begin(), shares.end()))
        << count;
  }
}

TEST(Resampling, AParticleThatHasAllTheWeightIsAlwaysDrawn) {
  std::mt19937 generator(4);
  const WeightedDraw drawn({-900.0, 0.0, -900.0});
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(drawn(generator), 1U);
}

}  // namespace
}  // namespace tagfield
