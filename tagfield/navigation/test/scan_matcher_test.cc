// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/scan_matcher.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

const Eigen::Matrix3d kLoose = Eigen::Matrix3d::Identity() * 1e-3;

/// Points along three walls, 2 cm apart, exact.
std::vector<Eigen::Vector2d> corner_points() {
  std::vector<Eigen::Vector2d> points;
  for (double s = -2.0; s <= 2.0; s += 0.02) {
    points.emplace_back(3.013, s);
    points.emplace_back(s, 2.037);
    points.emplace_back(s, -2.024);
  }
  return points;
}

HitGrid map_of(const std::vector<Eigen::Vector2d>& points) {
  HitGrid map(0.05);
  map.add_ends(points);
  map.add_ends(points);
  return map;
}

std::vector<Eigen::Vector2d> seen_from(const PlanarPose& pose,
                                       const std::vector<Eigen::Vector2d>& points_M) {
  std::vector<Eigen::Vector2d> seen;
  const PlanarPose back = between(pose, {});
  for (const Eigen::Vector2d& p : points_M) seen.push_back(transformed(back, p));
  return seen;
}

TEST(ScanMatcher, FindsThePoseFarBelowTheCell) {
  const HitGrid map = map_of(corner_points());
  for (const double yaw : {0.0, 0.4, -2.0, 3.1}) {
    const PlanarPose truth{0.31, -0.17, yaw};
    const PlanarPose guess{truth.x + 0.08, truth.y - 0.06, truth.yaw + 0.03};
    const ScanMatch match =
        match_scan(map, seen_from(truth, corner_points()), guess, guess, kLoose, {});
    EXPECT_NEAR(match.pose_M.x, truth.x, 1e-3) << yaw;
    EXPECT_NEAR(match.pose_M.y, truth.y, 1e-3) << yaw;
    EXPECT_NEAR(match.pose_M.yaw, truth.yaw, 1e-3) << yaw;
    EXPECT_NEAR(match.matched_share, 1.0, 1e-12);
    EXPECT_LT(match.rms_m, 2e-3);
  }
}

// A wall one standard deviation from a cell border: five of six endpoints are on its side, which a
// limit on endpoints makes three of six.
TEST(ScanMatcher, AWallNearABorderOfCellsIsWhereItsEndsAreInTheMean) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 0.01);
  std::vector<Eigen::Vector2d> wall;
  for (double y = -2.0; y <= 2.0; y += 0.02) wall.emplace_back(3.01, y);
  HitGrid map(0.05);
  for (int scan = 0; scan < 100; ++scan) {
    std::vector<Eigen::Vector2d> ends = wall;
    for (Eigen::Vector2d& end : ends) end.x() += noise(random);
    map.add_ends(ends);
  }
  MatchOptions limited;
  limited.max_ends = 20.0;
  EXPECT_NEAR(match_scan(map, wall, {}, {}, kLoose, {}).pose_M.x, 0.0, 5e-4);
  EXPECT_GT(std::abs(match_scan(map, wall, {}, {}, kLoose, limited).pose_M.x), 2e-3);
}

TEST(ScanMatcher, AlongAWallThePriorDecides) {
  std::vector<Eigen::Vector2d> wall;
  for (double y = -6.0; y <= 6.0; y += 0.02) wall.emplace_back(1.0, y);
  const HitGrid map = map_of(wall);
  std::vector<Eigen::Vector2d> part(wall.begin() + 200, wall.begin() + 400);
  const PlanarPose guess{0.05, 0.12, 0.0};
  Eigen::Matrix3d prior = Eigen::Matrix3d::Identity() * 100.0;
  const ScanMatch match = match_scan(map, part, guess, guess, prior, {});
  EXPECT_NEAR(match.pose_M.x, 0.0, 2e-3);   // across the wall: the map
  EXPECT_NEAR(match.pose_M.y, 0.12, 1e-3);  // along it: nothing but the prior
  EXPECT_NEAR(match.information(1, 1), 100.0, 1.0);
  EXPECT_GT(match.information(0, 0), 1000.0);
}

TEST(ScanMatcher, OutliersAreOutvoted) {
  const HitGrid map = map_of(corner_points());
  const PlanarPose truth{0.2, 0.1, 0.2};
  std::vector<Eigen::Vector2d> points = seen_from(truth, corner_points());
  // A fifth of the points are on an object that is not on the map.
  for (std::size_t i = 0; i < points.size(); i += 5) points[i] *= 0.6;
  const PlanarPose guess{0.23, 0.08, 0.21};
  const ScanMatch match = match_scan(map, points, guess, guess, kLoose, {});
  EXPECT_LT((position_of(match.pose_M) - position_of(truth)).norm(), 5e-3);
  EXPECT_LT(match.matched_share, 0.9);
}

TEST(ScanMatcher, OnAnEmptyMapThePriorStays) {
  const HitGrid map(0.05);
  const PlanarPose prior{1.0, 2.0, 0.5};
  const ScanMatch match = match_scan(map, corner_points(), prior, prior, kLoose, {});
  EXPECT_EQ(match.pose_M.x, prior.x);
  EXPECT_EQ(match.pose_M.yaw, prior.yaw);
  EXPECT_EQ(match.matched_share, 0.0);
  const ScanMatch without = match_scan(map, {}, prior, prior, kLoose, {});
  EXPECT_EQ(without.pose_M.x, prior.x);
  EXPECT_TRUE(std::isfinite(without.cost));
}

}  // namespace
}  // namespace tagfield
