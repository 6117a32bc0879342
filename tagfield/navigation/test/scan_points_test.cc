// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/scan_points.h"

#include <gtest/gtest.h>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

LaserScan three_beams(float right, float ahead, float left) {
  LaserScan scan;
  scan.first_angle_rad = -kPi / 2.0;
  scan.angle_step_rad = kPi / 2.0;
  scan.min_range_m = 0.2;
  scan.max_range_m = 10.0;
  scan.ranges_m = {right, ahead, left};
  return scan;
}

TEST(ScanPoints, BeamsBecomePointsOnTheRobot) {
  // A laser 0.5 m ahead of the base, facing left.
  const RigidTransform X_RL = from_xyz_rpy({0.5, 0.1, 0.3}, {0.0, 0.0, kPi / 2.0});
  const ScanPoints points = scan_points(three_beams(1.0F, 2.0F, 3.0F), X_RL, 5.0);
  ASSERT_EQ(points.ends_R.size(), 3U);
  EXPECT_TRUE(points.ends_R[0].isApprox(Eigen::Vector2d(1.5, 0.1), 1e-6));
  EXPECT_TRUE(points.ends_R[1].isApprox(Eigen::Vector2d(0.5, 2.1), 1e-6));
  EXPECT_TRUE(points.ends_R[2].isApprox(Eigen::Vector2d(-2.5, 0.1), 1e-6));
  EXPECT_TRUE(points.sensor_R.isApprox(Eigen::Vector2d(0.5, 0.1), 1e-12));
}

TEST(ScanPoints, WhatMetNothingIsClearAndWhatMeansNothingIsLeftOut) {
  const ScanPoints points = scan_points(three_beams(0.0F, 11.0F, 0.1F), {}, 5.0);
  EXPECT_TRUE(points.ends_R.empty());
  ASSERT_EQ(points.clear_R.size(), 1U);
  EXPECT_TRUE(points.clear_R[0].isApprox(Eigen::Vector2d(5.0, 0.0), 1e-9));
  EXPECT_NEAR(scan_points(three_beams(0.0F, 11.0F, 0.1F), {}, 50.0).clear_R[0].x(), 10.0, 1e-9);
}

TEST(ScanPoints, ThinnedKeepsADistance) {
  std::vector<Eigen::Vector2d> row;
  for (int i = 0; i < 100; ++i) row.emplace_back(0.01 * i, 0.0);
  const auto few = thinned(row, 0.095);
  EXPECT_EQ(few.size(), 10U);
  EXPECT_EQ(thinned(row, 0.0).size(), 100U);
  EXPECT_TRUE(thinned({}, 1.0).empty());
}

LaserScan turning_scan(std::size_t beams, float range) {
  LaserScan scan;
  scan.first_angle_rad = -2.0;
  scan.angle_step_rad = 4.0 / static_cast<double>(beams - 1);
  scan.min_range_m = 0.01;
  scan.max_range_m = 10.0;
  scan.ranges_m.assign(beams, range);
  return scan;
}

TEST(ScanPoints, SparseEndsAreEvenlySomeOfAll) {
  const RigidTransform X_RL = from_xyz_rpy({0.2, -0.1, 0.3}, {0.0, 0.0, 0.7});
  const LaserScan scan = turning_scan(361, 4.0F);
  const std::vector<Eigen::Vector2d> all = scan_points(scan, X_RL, 0.0).ends_R;
  const std::vector<Eigen::Vector2f> few = sparse_ends(scan, X_RL, 90, 0.01);
  ASSERT_EQ(few.size(), 91U);
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_LT((few[i].cast<double>() - all[4 * i]).norm(), 1e-5) << i;
  }
  EXPECT_EQ(sparse_ends(scan, X_RL, 1000, 0.01).size(), 361U);
  EXPECT_EQ(sparse_ends(scan, X_RL, 0, 0.01).size(), 1U);
  EXPECT_TRUE(sparse_ends({}, X_RL, 90, 0.01).empty());
}

TEST(ScanPoints, SparseEndsLieApartAndNotRightAfterAGap) {
  // Neighbours are 4 cm apart, every third of them 12 cm.
  LaserScan scan = turning_scan(101, 1.0F);
  EXPECT_EQ(sparse_ends(scan, {}, 101, 0.039).size(), 101U);
  // The last is kept.
  EXPECT_EQ(sparse_ends(scan, {}, 101, 0.1).size(), 1U + 33U + 1U);
  scan.ranges_m[50] = 0.0F;
  EXPECT_EQ(sparse_ends(scan, {}, 101, 0.039).size(), 99U);
}

}  // namespace
}  // namespace tagfield
