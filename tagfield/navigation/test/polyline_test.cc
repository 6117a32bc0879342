// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/polyline.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace tagfield {
namespace {

const std::vector<Eigen::Vector2d> kCorner = {{0.0, 0.0}, {3.0, 0.0}, {3.0, 4.0}};

TEST(Polyline, IsMeasuredAlongItself) {
  const Polyline line(kCorner);
  EXPECT_EQ(line.length_m(), 7.0);
  EXPECT_EQ(line.at(1.0), Eigen::Vector2d(1.0, 0.0));
  EXPECT_EQ(line.at(3.0), Eigen::Vector2d(3.0, 0.0));
  EXPECT_EQ(line.at(5.0), Eigen::Vector2d(3.0, 2.0));
  EXPECT_EQ(line.at(-1.0), kCorner.front());
  EXPECT_EQ(line.at(99.0), kCorner.back());
}

TEST(Polyline, LeavesOutRepeatedPoints) {
  const Polyline line(std::vector<Eigen::Vector2d>{{0.0, 0.0}, {0.0, 0.0}, {1.0, 0.0}, {1.0, 0.0}});
  EXPECT_EQ(line.points().size(), 2U);
  EXPECT_TRUE(Polyline().empty());
  EXPECT_EQ(Polyline().length_m(), 0.0);
  EXPECT_TRUE(Polyline().between(0.0, 1.0).empty());
  const Polyline point(std::vector<Eigen::Vector2d>{{2.0, 1.0}});
  EXPECT_EQ(point.length_m(), 0.0);
  EXPECT_EQ(point.at(1.0), Eigen::Vector2d(2.0, 1.0));
  EXPECT_EQ(point.nearest({2.0, 4.0}, 0.0, 1.0).distance_m, 3.0);
}

TEST(Polyline, PartsHaveTheCornersBetween) {
  const Polyline line(kCorner);
  const std::vector<Eigen::Vector2d> part = line.between(2.0, 4.0);
  ASSERT_EQ(part.size(), 3U);
  EXPECT_EQ(part[0], Eigen::Vector2d(2.0, 0.0));
  EXPECT_EQ(part[1], kCorner[1]);
  EXPECT_EQ(part[2], Eigen::Vector2d(3.0, 1.0));
  EXPECT_EQ(line.between(5.0, 5.0).size(), 1U);
}

TEST(Polyline, LooksForTheFootOnlyInTheGivenStretch) {
  const Polyline there_and_back(
      std::vector<Eigen::Vector2d>{{0.0, 0.0}, {5.0, 0.0}, {5.0, 0.1}, {0.0, 0.1}});
  EXPECT_EQ(there_and_back.nearest({1.0, 0.1}, 0.0, 3.0).along_m, 1.0);
  EXPECT_NEAR(there_and_back.nearest({1.0, 0.1}, 3.0, 99.0).along_m, 9.1, 1e-12);
}

RC_GTEST_PROP(PolylineProperties, NoPlaceIsNearerThanTheFoot, ()) {
  const auto draw = [] { return *rc::gen::inRange(-1000, 1000) * 0.01; };
  std::vector<Eigen::Vector2d> points;
  for (int i = *rc::gen::inRange(1, 8); i > 0; --i) points.emplace_back(draw(), draw());
  const Polyline line(points);
  const Eigen::Vector2d p(draw(), draw());
  const Polyline::Foot foot = line.nearest(p, 0.0, line.length_m());
  RC_ASSERT(std::abs((line.at(foot.along_m) - p).norm() - foot.distance_m) < 1e-9);
  for (int i = 0; i <= 200; ++i) {
    RC_ASSERT((line.at(line.length_m() * i / 200.0) - p).norm() > foot.distance_m - 1e-9);
  }
}

}  // namespace
}  // namespace tagfield
