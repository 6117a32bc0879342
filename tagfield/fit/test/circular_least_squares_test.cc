// SPDX-License-Identifier: Apache-2.0
#include "tagfield/fit/circular_least_squares.h"

#include <gtest/gtest.h>

#include <random>

namespace tagfield {
namespace {

using Rng = std::mt19937_64;

double uniform(Rng& rng, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(rng);
}
double normal(Rng& rng, double sigma) {
  return sigma > 0.0 ? std::normal_distribution<double>(0.0, sigma)(rng) : 0.0;
}

using Rows = std::vector<CircularRow<2>>;

/// Angles with random slopes, minus the prediction for `theta`.
Rows rows_at(const Eigen::Vector2d& theta, std::uint64_t seed, double noise) {
  Rng rng(seed);
  Rows rows;
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector2d slope{uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 1.0)};
    const double measured = 0.7 + slope.dot(Eigen::Vector2d(0.2, -0.3)) + normal(rng, noise);
    rows.push_back({measured - slope.dot(theta), slope});
  }
  return rows;
}

CircularNormal<2> normal_of(const Rows& rows, bool offset_free) {
  CircularNormal<2> normal;
  add_angles(rows, offset_free, 3.0, normal);
  return normal;
}

TEST(CircularLeastSquares, ItsRightSideIsTheGradientOfTheCost) {
  constexpr double kStep = 1e-6;
  for (const bool offset_free : {false, true}) {
    const Eigen::Vector2d theta(0.05, -0.1);
    const CircularNormal<2> here = normal_of(rows_at(theta, 1, 0.3), offset_free);
    for (int d = 0; d < 2; ++d) {
      const Eigen::Vector2d step = kStep * Eigen::Vector2d::Unit(d);
      const double up = normal_of(rows_at(theta + step, 1, 0.3), offset_free).cost;
      const double down = normal_of(rows_at(theta - step, 1, 0.3), offset_free).cost;
      EXPECT_NEAR(here.right(d), -(up - down) / (2.0 * kStep), 1e-6) << offset_free;
    }
  }
}

TEST(CircularLeastSquares, WithoutNoiseOneStepIsTheWay) {
  const CircularNormal<2> normal = normal_of(rows_at({0.199, -0.299}, 2, 0.0), true);
  const Eigen::Vector2d step = normal.matrix.inverse() * normal.right;
  EXPECT_LT((step - Eigen::Vector2d(0.001, -0.001)).norm(), 1e-8);
}

TEST(CircularLeastSquares, WholeTurnsChangeNothing) {
  Rows rows = rows_at({0.0, 0.0}, 3, 0.5);
  const CircularNormal<2> before = normal_of(rows, true);
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows[i].angle += kTwoPi * static_cast<double>(i % 5);
  const CircularNormal<2> after = normal_of(rows, true);
  EXPECT_NEAR(after.cost, before.cost, 1e-9);
  EXPECT_TRUE(after.matrix.isApprox(before.matrix, 1e-9));
  EXPECT_TRUE(after.right.isApprox(before.right, 1e-9));
  EXPECT_EQ(after.residuals.size(), rows.size());
}

TEST(FitAngles, FindsWhatTheAnglesWereMadeOf) {
  const auto normal_at = [](const Eigen::Vector2d& theta) {
    return normal_of(rows_at(theta, 4, 0.0), true);
  };
  const auto found = fit_angles<2>(Eigen::Vector2d(-0.5, 0.5), {}, normal_at,
                                   [](const Eigen::Vector2d&) { return true; });
  EXPECT_LT((found.unknowns - Eigen::Vector2d(0.2, -0.3)).norm(), 1e-6);
  EXPECT_LT(found.cost, 1e-9);
}

TEST(FitAngles, StaysWhereNothingElseIsAllowed) {
  const Eigen::Vector2d start(-0.5, 0.5);
  const auto found = fit_angles<2>(
      start, {},
      [](const Eigen::Vector2d& theta) { return normal_of(rows_at(theta, 4, 0.0), true); },
      [](const Eigen::Vector2d&) { return false; });
  EXPECT_EQ(found.unknowns, start);
}

TEST(CircularMean, OfAnglesAcrossHalfATurn) {
  CircularMean mean;
  EXPECT_EQ(mean.value(), 0.0);
  mean.add(radians(170.0));
  mean.add(radians(-160.0));
  EXPECT_NEAR(mean.value(), radians(-175.0), 1e-12);
}

/// Unit vectors of lengths 3 and 4 at right angles add up to one at atan(4/3).
TEST(CircularMean, WeightsAreLengths) {
  CircularMean mean;
  mean.add(0.0, 3.0);
  mean.add(kPi / 2.0, 4.0);
  EXPECT_NEAR(mean.value(), std::atan2(4.0, 3.0), 1e-12);
}

}  // namespace
}  // namespace tagfield
