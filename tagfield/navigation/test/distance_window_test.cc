// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/distance_window.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "tagfield/navigation/test/test_worlds.h"

namespace tagfield {
namespace {

using testing::room_of;

TEST(DistanceWindow, KnowsTheMapsWalls) {
  const OccupancyGrid room = room_of(10.0, 6.0);
  const DistanceWindow window(room, {}, {1.0, 3.0}, 2.0, 1.5);
  EXPECT_NEAR(window.at({0.525, 3.0}), 0.5, 1e-6);  // The centres of the wall's cells are at 0.025.
  EXPECT_NEAR(window.at({1.0, 3.0}), 0.975, 1e-6);
  EXPECT_GE(window.at({2.5, 3.0}), 1.5);
  EXPECT_LE(window.at({2.5, 3.0}), 1.6);
}

TEST(DistanceWindow, IsZeroBeyondItself) {
  const DistanceWindow window(room_of(10.0, 6.0), {}, {5.0, 3.0}, 1.0, 1.5);
  EXPECT_EQ(window.at({6.5, 3.0}), 0.0);
  EXPECT_EQ(window.at({5.0, -100.0}), 0.0);
  EXPECT_EQ(window.at({std::numeric_limits<double>::quiet_NaN(), 3.0}), 0.0);
  EXPECT_GT(window.at({5.9, 3.0}), 1.0);
}

TEST(DistanceWindow, ReachesBeyondTheMap) {
  const DistanceWindow window(room_of(2.0, 2.0), {{3.0, 3.0}}, {2.5, 2.5}, 1.5, 1.0);
  EXPECT_NEAR(window.at({3.0, 3.5}), 0.5, 0.04);
}

RC_GTEST_PROP(DistanceWindowProperties, IsNearTheDistanceToThePoints, ()) {
  const auto draw = [] { return *rc::gen::inRange(3000, 7000) * 0.001; };
  std::vector<Eigen::Vector2d> points;
  for (int i = *rc::gen::inRange(1, 10); i > 0; --i) points.emplace_back(draw(), draw());
  const DistanceWindow window(room_of(10.0, 10.0), points, {5.0, 5.0}, 2.5, 2.0);
  const Eigen::Vector2d p(draw(), draw());
  double nearest = 2.0;
  for (const Eigen::Vector2d& point : points) nearest = std::min(nearest, (point - p).norm());
  const double off = window.at(p) - nearest;
  RC_ASSERT(std::abs(off) < 0.7 * 0.05 + 0.5 * 0.05 || nearest > 1.9);
}

}  // namespace
}  // namespace tagfield
