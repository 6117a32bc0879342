// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/circle_density.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tagfield/base/random.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

/// The formula in double precision.
double exactly(const PhaseDifference& of, double delta) {
  const auto d = static_cast<double>(of.rad);
  const auto sigma = static_cast<double>(of.sigma);
  const auto a = static_cast<double>(of.arbitrary);
  const double x = std::remainder(delta - d, kTwoPi);
  const double normal = std::exp(-0.5 * x * x / (sigma * sigma)) / (sigma * std::sqrt(kTwoPi));
  return std::log((1.0 - a) * normal + a / kTwoPi);
}

TEST(CircleDensity, IsTheFormulaOnEachInstructionSet) {
  RandomStream stream(1, Purpose::kReadNoise);
  for (int draw = 0; draw < 2000; ++draw) {
    const PhaseDifference of{static_cast<float>((uniform(stream) - 0.5) * kTwoPi),
                             static_cast<float>(0.1 + 2.0 * uniform(stream)),
                             static_cast<float>(std::pow(10.0, -6.0 * uniform(stream)))};
    const OnCircle density = log_density(of);
    for (Eigen::Index i = 0; i < kCircleBins; ++i) {
      const double delta = kTwoPi * static_cast<double>(i) / static_cast<double>(kCircleBins);
      ASSERT_NEAR(density[i], exactly(of, delta), 1e-4) << of.rad << ' ' << of.sigma << ' ' << i;
    }
    for (const InstructionSet set : instruction_sets()) {
      ASSERT_TRUE((log_density(of, set) == density).all());
    }
  }
}

}  // namespace
}  // namespace tagfield
