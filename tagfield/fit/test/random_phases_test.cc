// SPDX-License-Identifier: Apache-2.0
#include "tagfield/fit/random_phases.h"

#include <gtest/gtest.h>

#include <random>

#include "tagfield/base/units.h"
#include "tagfield/fit/circular_mean.h"
#include "tagfield/fit/robust_noise.h"

namespace tagfield {
namespace {

/// Evidence of the simplest fit: one offset to phases.
double evidence_of(const std::vector<double>& phases) {
  CircularMean mean;
  for (const double phase : phases) mean.add(phase);
  std::vector<double> residuals;
  for (const double phase : phases) residuals.push_back(wrap_to_pi(phase - mean.value()));
  const double noise = robust_noise(residuals, 1, 0.02);
  return evidence_of_residuals(residuals, noise, 0.02) + evidence_of_offset(phases.size(), noise);
}

std::vector<double> draw(std::mt19937_64& rng, std::size_t count, double noise_rad) {
  std::vector<double> phases;
  for (std::size_t i = 0; i < count; ++i) {
    phases.push_back(noise_rad > 0.0
                         ? wrap_to_pi(1.0 + std::normal_distribution<double>(0.0, noise_rad)(rng))
                         : std::uniform_real_distribution<double>(-kPi, kPi)(rng));
  }
  return phases;
}

// With 10,000 draws and a probability of 1 % the count has a standard deviation of 10.
TEST(RandomPhases, AreBelievedInOneCaseOfAHundredAtMost) {
  std::mt19937_64 rng(1);
  for (const std::size_t count : {3U, 5U, 10U, 30U, 100U}) {
    int believed = 0;
    for (int i = 0; i < 10'000; ++i) {
      believed += evidence_of(draw(rng, count, 0.0)) >= kMinEvidence ? 1 : 0;
    }
    EXPECT_LE(believed, 100) << count << " reads";
  }
}

TEST(RandomPhases, OfAModelThatHoldsAreBelieved) {
  std::mt19937_64 rng(2);
  int believed = 0;
  for (int i = 0; i < 1'000; ++i) {
    believed += evidence_of(draw(rng, 10, 0.2)) >= kMinEvidence ? 1 : 0;
  }
  EXPECT_GE(believed, 990);
}

// Compared with numerical integration of the evidence of one offset, for a known noise.
TEST(RandomPhases, AnOffsetCostsWhatItsPriorSays) {
  const double noise = 0.3;
  const std::vector<double> residuals = {0.2, -0.1, -0.3, 0.15, 0.05};
  double integral = 0.0;
  constexpr int kSteps = 20'000;
  for (int i = 0; i < kSteps; ++i) {
    const double offset = -kPi + (i + 0.5) * kTwoPi / kSteps;
    double likelihood = 1.0;
    for (const double residual : residuals) {
      const double z = wrap_to_pi(residual - offset) / noise;
      likelihood *= std::sqrt(kTwoPi) / noise * std::exp(-0.5 * z * z);
    }
    integral += likelihood / kSteps;
  }
  double at_best = 0.0;
  for (const double residual : residuals) {
    at_best += std::log(std::sqrt(kTwoPi) / noise) - 0.5 * residual * residual / (noise * noise);
  }
  EXPECT_NEAR(at_best + evidence_of_offset(residuals.size(), noise), std::log(integral), 1e-6);
}

}  // namespace
}  // namespace tagfield
