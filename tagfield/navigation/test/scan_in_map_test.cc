// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/scan_in_map.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "tagfield/base/units.h"
#include "tagfield/motion/planar_pose.h"
#include "tagfield/navigation/test/test_worlds.h"

namespace tagfield {
namespace {

using testing::kLaser;

LaserScan scan_of(std::vector<float> ranges, double first = -kPi / 2.0, double last = kPi / 2.0) {
  LaserScan scan;
  scan.first_angle_rad = first;
  scan.angle_step_rad = (last - first) / static_cast<double>(ranges.size() - 1);
  scan.min_range_m = 0.3;
  scan.max_range_m = 10.0;
  scan.ranges_m = std::move(ranges);
  return scan;
}

TEST(ScanInMap, PlacesReturns) {
  // Right, ahead, left of a robot at (1, 2) facing along y.
  const ScanInMap seen =
      scan_in_map(scan_of({2.0F, 3.0F, 11.0F}), kLaser, {1.0, 2.0, kPi / 2.0}, {});
  ASSERT_EQ(seen.returns.size(), 2U);
  EXPECT_LT((seen.returns[0].point_M - Eigen::Vector2d(3.0, 2.15)).norm(), 1e-6);
  EXPECT_LT((seen.returns[1].point_M - Eigen::Vector2d(1.0, 5.15)).norm(), 1e-6);
  EXPECT_EQ(seen.returns[1].beam, 1U);
  EXPECT_EQ(seen.valid_share, 1.0);
  EXPECT_EQ(seen.clear_m, (std::vector<double>{2.0, 3.0, 10.0}));
}

TEST(ScanInMap, TurnsWithALaserThatIsMountedTurned) {
  const ScanInMap seen = scan_in_map(scan_of({2.0F, 3.0F, 2.0F}),
                                     from_xyz_rpy({-0.2, 0.0, 0.3}, {0.0, 0.0, kPi}), {}, {});
  EXPECT_LT((seen.returns[1].point_M - Eigen::Vector2d(-3.2, 0.0)).norm(), 1e-6);
}

TEST(ScanInMap, StraightensASweep) {
  // The robot turns at 1 rad/s, and the last beam is taken 0.1 s after the first.
  LaserScan scan = scan_of({2.0F, 2.0F, 2.0F});
  scan.beam_interval = std::chrono::milliseconds(50);
  const ScanInMap seen = scan_in_map(scan, from_translation({0.0, 0.0, 0.3}), {}, {0.0, 1.0});
  EXPECT_LT((seen.returns[2].point_M - 2.0 * Eigen::Vector2d(-std::sin(0.1), std::cos(0.1))).norm(),
            1e-6);
}

TEST(ScanInMap, ClearTowardsIsTheLeastNearby) {
  const ScanInMap seen = scan_in_map(scan_of({5.0F, 5.0F, 1.0F, 5.0F, 5.0F}), kLaser, {}, {});
  EXPECT_EQ(seen.clear_towards({3.0, 0.0}, 0.01), 1.0);
  EXPECT_EQ(seen.clear_towards({0.15, 3.0}, 0.01), 5.0);
  EXPECT_EQ(seen.clear_towards({-3.0, 0.0}, 0.01), 0.0);
}

TEST(ScanInMap, ClearTowardsWorksRoundAFullTurn) {
  const std::vector<float> ranges(360, 4.0F);
  const ScanInMap seen = scan_in_map(scan_of(ranges, 0.0, radians(359.0)), kLaser, {}, {});
  for (int i = 0; i < 360; i += 7) {
    const double angle = radians(i);
    EXPECT_EQ(seen.clear_towards({0.15 + std::cos(angle), std::sin(angle)}, 0.001), 4.0) << i;
  }
}

TEST(ScanInMap, NothingIsKnownOfWideRowsOfInvalidBeams) {
  std::vector<float> ranges(181, 5.0F);
  for (std::size_t i = 85; i < 96; ++i) ranges[i] = 0.0F;  // 11° ahead
  ranges[20] = 0.0F;                                       // a single beam: ignored
  const ScanInMap seen = scan_in_map(scan_of(ranges), kLaser, {}, {});
  ASSERT_GE(seen.may_be_M.size(), 4U);
  for (const Eigen::Vector2d& point : seen.may_be_M) {
    EXPECT_NEAR((point - Eigen::Vector2d(0.15, 0.0)).norm(), 0.3, 1e-9);
    EXPECT_LT(std::abs(point.y()), 0.3 * std::sin(radians(6.0)));
  }
  EXPECT_EQ(seen.clear_towards({3.0, 0.0}, 0.01), 0.0);
  EXPECT_NEAR(seen.valid_share, 169.0 / 181.0, 1e-12);
}

TEST(ScanInMap, BearsAnything) {
  LaserScan scan;
  EXPECT_TRUE(scan_in_map(scan, kLaser, {}, {}).returns.empty());
  scan = scan_of({std::nanf(""), -1.0F, HUGE_VALF, 2.0F});
  const ScanInMap seen = scan_in_map(scan, kLaser, {}, {});
  EXPECT_EQ(seen.returns.size(), 1U);
  EXPECT_EQ(seen.valid_share, 0.5);
  scan.angle_step_rad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(scan_in_map(scan, kLaser, {}, {}).returns.empty());
  EXPECT_EQ(scan_in_map(scan, kLaser, {}, {}).clear_towards({1.0, 0.0}, 0.1), 0.0);
}

/// Each point is carried along the arc until its beam, to the last bit, also at yaws beyond the
/// domain of sines in lanes.
RC_GTEST_PROP(ScanInMapProperties, LatePointsAreCarriedAlongTheArc, ()) {
  const auto place = [] { return 0.01 * *rc::gen::inRange(-900, 900); };
  LaserScan scan = scan_of(std::vector<float>(181, 4.0F));
  const PlanarPose pose{place(), place(), place() * *rc::gen::element(1.0, 1e5)};
  const BodyVelocity velocity{0.1 * place(), *rc::gen::element(0.0, 1e-9, 0.1) * place()};
  const ScanInMap at_once = scan_in_map(scan, kLaser, pose, velocity);
  scan.beam_interval = std::chrono::microseconds(200);
  const ScanInMap late = scan_in_map(scan, kLaser, pose, velocity);
  RC_ASSERT(late.returns.size() == 181U);
  RC_ASSERT(late.returns[0].point_M == at_once.returns[0].point_M);
  for (std::size_t i = 1; i < late.returns.size(); ++i) {
    const Eigen::Vector2d& seen = at_once.returns[i].point_M;
    const PlanarPose in_robot = between(pose, {seen.x(), seen.y(), 0.0});
    const PlanarPose then =
        advance(pose, velocity, static_cast<double>(i) * to_seconds(scan.beam_interval));
    RC_ASSERT(late.returns[i].point_M == transformed(then, {in_robot.x, in_robot.y}));
  }
}

RC_GTEST_PROP(ScanInMapProperties, PointsAreTheirRangesAway, ()) {
  std::vector<float> ranges;
  for (int i = 0; i < 50; ++i)
    ranges.push_back(static_cast<float>(*rc::gen::inRange(31, 900)) * 0.01F);
  const auto draw = [] { return *rc::gen::inRange(-10'000, 10'000) * 1e-3; };
  const PlanarPose pose{draw(), draw(), draw()};
  const ScanInMap seen = scan_in_map(scan_of(ranges), kLaser, pose, {});
  RC_ASSERT(seen.returns.size() == 50U);
  const RigidTransform X_ML = to_transform(pose) * kLaser;
  for (const ScanReturn& hit : seen.returns) {
    const Eigen::Vector3d p_L =
        X_ML.inverse() * Eigen::Vector3d(hit.point_M.x(), hit.point_M.y(), 0.31);
    const double angle = -kPi / 2.0 + kPi * static_cast<double>(hit.beam) / 49.0;
    const auto range = static_cast<double>(ranges[hit.beam]);
    RC_ASSERT((p_L.head<2>() - range * Eigen::Vector2d(std::cos(angle), std::sin(angle))).norm() <
              1e-9);
  }
}

}  // namespace
}  // namespace tagfield
