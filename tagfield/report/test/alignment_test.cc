// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/alignment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace tagfield {
namespace {

const std::vector<Eigen::Vector2d> kCorners = {{4.58, -6.4}, {4.58, 3.4}, {-4.58, 0.0}, {1.0, 2.0}};

TEST(Alignment, FindsAKnownMotion) {
  for (const double yaw : {0.0, 0.02, -1.3, 3.1}) {
    std::vector<Eigen::Vector2d> moved;
    for (const Eigen::Vector2d& p : kCorners) {
      moved.emplace_back(std::cos(yaw) * p.x() - std::sin(yaw) * p.y() + 0.3,
                         std::sin(yaw) * p.x() + std::cos(yaw) * p.y() - 7.0);
    }
    const PlanarMotion motion = best_motion(kCorners, moved);
    EXPECT_NEAR(motion.yaw_rad, yaw, 1e-12);
    for (std::size_t i = 0; i < kCorners.size(); ++i) {
      EXPECT_NEAR((motion * kCorners[i] - moved[i]).norm(), 0.0, 1e-12);
    }
  }
}

TEST(Alignment, HasNoScale) {
  // Twice as large about the mean: nothing to rotate or shift, so half of each distance remains.
  const std::vector<Eigen::Vector2d> small = {{-1, 0}, {1, 0}, {0, 1}, {0, -1}};
  std::vector<Eigen::Vector2d> large;
  for (const Eigen::Vector2d& p : small) large.emplace_back(2.0 * p);
  const PlanarMotion motion = best_motion(small, large);
  EXPECT_NEAR(motion.yaw_rad, 0.0, 1e-12);
  EXPECT_NEAR((motion * small[0] - large[0]).norm(), 1.0, 1e-12);
}

TEST(Alignment, NoMotionNearItIsBetter) {
  const std::vector<Eigen::Vector2d> seen = {{4.6, -6.3}, {4.5, 3.5}, {-4.6, 0.1}, {1.2, 1.9}};
  const auto cost = [&](const PlanarMotion& motion) {
    double sum = 0.0;
    for (std::size_t i = 0; i < seen.size(); ++i)
      sum += (motion * seen[i] - kCorners[i]).squaredNorm();
    return sum;
  };
  const PlanarMotion best = best_motion(seen, kCorners);
  for (const double step : {-1e-3, 1e-3}) {
    EXPECT_LT(cost(best), cost({best.yaw_rad + step, best.shift_m}));
    EXPECT_LT(cost(best), cost({best.yaw_rad, best.shift_m + Eigen::Vector2d(step, 0)}));
    EXPECT_LT(cost(best), cost({best.yaw_rad, best.shift_m + Eigen::Vector2d(0, step)}));
  }
}

TEST(Alignment, OfNothingMovesNothing) {
  EXPECT_EQ(best_motion({}, {}) * Eigen::Vector2d(1, 2), Eigen::Vector2d(1, 2));
}

}  // namespace
}  // namespace tagfield
