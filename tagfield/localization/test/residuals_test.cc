#include "tagfield/localization/residuals.h"

#include <gtest/gtest.h>

#include "made_reads.h"

namespace tagfield {
namespace {

using namespace made;

FitData one_span(Eigen::Index count) {
  FitData data;
  data.spans.push_back({0, count, 0.17});
  return data;
}

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
  EXPECT_EQ(correlation_factor(FitData{}, Eigen::ArrayXd{}), 1.0);
}

TEST(ExpectedError, IsTheSpreadOfManyFits) {
  const Path path = s_curve(15.0, 0.02);
  const Eigen::Vector3d p_WT(4.0, 3.5, 0.4);
  Rng rng(9);
  double squares = 0.0;
  double expected = 0.0;
  constexpr int kFits = 200;
  for (int i = 0; i < kFits; ++i) {
    const auto segments = unwrap(read_along(path, p_WT, Noise{}, rng), 0.8);
    const FitData data = make_fit_data(segments, p_WT.z());
    const Eigen::Vector2d p = refine(data, p_WT.head<2>());
    squares += (p - p_WT.head<2>()).squaredNorm();
    expected += expected_error(data, p) / kFits;
  }
  EXPECT_NEAR(std::sqrt(squares / kFits), expected, 0.2 * expected);
}

TEST(TellsApart, OnlyWhatIsMoreThanChance) {
  Rng rng(10);
  constexpr Eigen::Index kCount = 700;
  const FitData data = one_span(kCount);
  const Eigen::ArrayXd best = 0.003 * series(kCount, 0.0, rng);
  EXPECT_FALSE(tells_apart(data, best, best));
  EXPECT_FALSE(tells_apart(data, best, best + 0.0003 * series(kCount, 0.0, rng)));
  EXPECT_TRUE(tells_apart(data, best, best + 0.006 * series(kCount, 0.9, rng)));
  // Two equally good explanations, independent of each other: no one is the better.
  EXPECT_FALSE(tells_apart(data, best, 0.003 * series(kCount, 0.0, rng)));
}

}  // namespace
}  // namespace tagfield
