// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/residuals.h"

#include <gtest/gtest.h>

#include "made_reads.h"

namespace tagfield {
namespace {

using namespace made;

Spans one_span(Eigen::Index count) { return {{0, count}}; }

/// An autoregressive series of the given lag-1 correlation and variance 1.
Eigen::ArrayXd series(Eigen::Index count, double keep, Rng& rng) {
  Eigen::ArrayXd values(count);
  double value = normal(rng, 1.0);
  for (Eigen::Index i = 0; i < count; ++i) {
    values[i] = value;
    value = keep * value + normal(rng, std::sqrt(1.0 - keep * keep));
  }
  return values;
}

TEST(NoiseOfOne, IsThatOfNeighbours) {
  Rng rng(9);
  constexpr Eigen::Index kCount = 100000;
  // ½ E Δ² = 1 − ρ; a slope adds half its square, and the step between two spans does not count.
  for (const double keep : {0.0, 0.5}) {
    Eigen::ArrayXd values = series(kCount, keep, rng);
    values += Eigen::ArrayXd::LinSpaced(kCount, 0.0, 1e-3 * kCount);
    values.tail(kCount / 2) += 1e6;
    const Spans halves{{0, kCount / 2}, {kCount / 2, kCount / 2}};
    EXPECT_NEAR(noise_of_one(halves, values), std::sqrt(1.0 - keep), 0.02);
  }
  EXPECT_EQ(noise_of_one(one_span(1), Eigen::ArrayXd::Ones(1)), 0.0);
}

TEST(CorrelationFactor, IsThatOfAnAutoregressiveSeries) {
  Rng rng(8);
  constexpr Eigen::Index kCount = 100000;
  EXPECT_NEAR(correlation_factor(one_span(kCount), series(kCount, 0.0, rng)), 1.0, 0.1);
  for (const double keep : {0.5, 0.9}) {
    const double expected = (1.0 + keep) / (1.0 - keep);
    EXPECT_NEAR(correlation_factor(one_span(kCount), series(kCount, keep, rng)), expected,
                0.25 * expected);
  }
}

TEST(CorrelationFactor, IsOneWithoutResiduals) {
  EXPECT_EQ(correlation_factor(one_span(10), Eigen::ArrayXd::Zero(10)), 1.0);
  EXPECT_EQ(correlation_factor({}, Eigen::ArrayXd{}), 1.0);
}

TEST(TellsApart, OnlyWhatIsMoreThanChance) {
  Rng rng(10);
  constexpr Eigen::Index kCount = 700;
  const Spans spans = one_span(kCount);
  const Eigen::ArrayXd best = 0.003 * series(kCount, 0.0, rng);
  EXPECT_FALSE(tells_apart(spans, best, best));
  EXPECT_FALSE(tells_apart(spans, best, best + 0.0003 * series(kCount, 0.0, rng)));
  EXPECT_TRUE(tells_apart(spans, best, best + 0.006 * series(kCount, 0.9, rng)));
  // Two equally good explanations, independent of each other: neither is better.
  EXPECT_FALSE(tells_apart(spans, best, 0.003 * series(kCount, 0.0, rng)));
}

}  // namespace
}  // namespace tagfield
