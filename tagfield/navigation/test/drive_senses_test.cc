// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/drive_senses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tagfield/base/error.h"
#include "tagfield/navigation/test/test_worlds.h"

namespace tagfield {
namespace {

using testing::BoxWorld;
using testing::kLaser;
using testing::paint;
using testing::walls;

const BoxWorld& sensed_hall() {
  static const BoxWorld world(walls({0.0, 0.0}, {10.0, 6.0}), {1.0, 1.0});
  return world;
}

LaserScan scan_from(const PlanarPose& pose, std::int64_t number, const Obstacles& obstacles = {}) {
  const RigidTransform X_WR = to_transform(pose);
  return simulate_scan(
      sensed_hall().rays, {}, number, [&](Time) { return X_WR; }, [&](Time) { return obstacles; },
      1, 1);
}

DriveSenses senses() {
  DriveSenses result(kLaser, 0.36);
  result.set_map(sensed_hall().map);
  return result;
}

const Obstacles kBox{{}, {{{4.0, 3.0}, {0.5, 0.5}, 0.0}}};
const PlanarPose kPose{2.0, 3.0, 0.0};

TEST(DriveSenses, TellsWhatIsOnTheMapFromWhatIsNot) {
  DriveSenses result = senses();
  for (int i = 0; i < 30; ++i) result.see(scan_from(kPose, i, kBox), kPose);
  const std::vector<Eigen::Vector2d> found = result.not_on_map();
  ASSERT_FALSE(found.empty());
  for (const Eigen::Vector2d& point : found) {
    EXPECT_LT((point - Eigen::Vector2d(4.0, 3.0)).cwiseAbs().maxCoeff(), 0.3);
  }
}

TEST(DriveSenses, APoseThatIsALittleOffPutsNoWallsOffTheMap) {
  DriveSenses result = senses();
  for (int i = 0; i < 30; ++i) {
    result.see(scan_from(kPose, i), {kPose.x + 0.02, kPose.y - 0.02, radians(0.5)});
  }
  EXPECT_TRUE(result.not_on_map().empty());
}

TEST(DriveSenses, WhoWalksIsMovingAndDoesNotStand) {
  DriveSenses result = senses();
  for (int i = 0; i < 45; ++i) {
    const Obstacles walker{{{{4.0, 1.5 + i / 30.0}, 0.3}}, {}};
    result.see(scan_from(kPose, i, walker), kPose);
  }
  const DistanceWindow window = result.window(kPose, 3.0, 1.0);
  const Surroundings around = result.surroundings(window, kPose, time_from_seconds(44.0 / 30.0));
  ASSERT_EQ(around.moving.size(), 1U);
  EXPECT_NEAR(around.moving[0].velocity_M.y(), 1.0, 0.15);
  EXPECT_GT(around.standing->at({4.0, 2.5}), 0.7);
  EXPECT_TRUE(result.not_on_map().empty());
}

TEST(DriveSenses, DistancesCountMapAndScan) {
  DriveSenses result = senses();
  for (int i = 0; i < 3; ++i) result.see(scan_from(kPose, i, kBox), kPose);
  const DistanceWindow window = result.window(kPose, 3.0, 1.0);
  EXPECT_NEAR(window.at({3.25, 3.0}), 0.5, 0.06);
  EXPECT_NEAR(window.at({1.0, 0.5}), 0.5, 0.06);
  const PlanarPose near{3.3, 3.0, 0.0};
  EXPECT_NEAR(result.surroundings(window, near, Time{}).clear_now_m, 0.45, 0.03);
  const PlanarPose at_wall{1.0, 0.4, 0.0};
  // The wall's face is somewhere within its cells.
  EXPECT_NEAR(result.surroundings(window, at_wall, Time{}).clear_now_m, 0.375, 0.026);
  EXPECT_NEAR(result.distance_to_map({1.0, 0.5}), 0.5, 0.05);
  EXPECT_EQ(result.distance_to_map({-50.0, 0.5}), DriveSenses::kMaxToMap);
}

TEST(DriveSenses, KnowsWhenItIsBlind) {
  DriveSenses result = senses();
  EXPECT_NE(result.blindness(Time{}), "");
  result.see(scan_from(kPose, 0), kPose);
  EXPECT_EQ(result.blindness(Time{}), "");
  EXPECT_EQ(result.blindness(time_from_seconds(0.4)), "");
  EXPECT_NE(result.blindness(time_from_seconds(0.6)).find("0.6 s old"), std::string::npos);
  EXPECT_NE(result.blindness(time_from_seconds(-0.6)).find("0.6 s in the future"),
            std::string::npos);
  LaserScan invalid = scan_from(kPose, 1);
  std::fill(invalid.ranges_m.begin(), invalid.ranges_m.end(), 0.0F);
  result.see(invalid, kPose);
  EXPECT_NE(result.blindness(Time{}).find("invalid"), std::string::npos);
}

TEST(DriveSenses, TakesNoScanFromNowhere) {
  DriveSenses result = senses();
  result.see(scan_from(kPose, 0), {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0});
  EXPECT_NE(result.blindness(Time{}), "");
}

TEST(DriveSenses, AnOlderScanBeginsAnew) {
  DriveSenses result = senses();
  for (int i = 100; i < 130; ++i) result.see(scan_from(kPose, i, kBox), kPose);
  EXPECT_FALSE(result.not_on_map().empty());
  result.see(scan_from(kPose, 0), kPose);
  EXPECT_TRUE(result.not_on_map().empty());
}

TEST(DriveSenses, GroundIsKnownByTheMapAndWhereTheRobotWas) {
  DriveSenses result(kLaser, 0.36);
  OccupancyGrid map = sensed_hall().map;
  paint(map, {0.0, 0.0}, {5.0, 6.0}, -1);
  result.set_map(map);
  for (int i = 0; i <= 20; ++i) result.be_at({2.0 + 0.1 * i, 3.0, 0.0}, {});
  const DistanceWindow window = result.window(kPose, 3.0, 1.0);
  const Surroundings around = result.surroundings(window, kPose, Time{});
  EXPECT_TRUE(around.is_known_free({3.0, 3.3}));
  EXPECT_FALSE(around.is_known_free({3.0, 3.6}));
  EXPECT_FALSE(around.is_known_free({1.0, 3.0}));
  EXPECT_TRUE(around.is_known_free({6.0, 3.0}));
}

TEST(DriveSenses, RefusesBrokenMaps) {
  DriveSenses result(kLaser, 0.36);
  OccupancyGrid map = sensed_hall().map;
  EXPECT_THROW(result.set_map({}), Error);
  map.resolution_m = 0.0;
  EXPECT_THROW(result.set_map(map), Error);
  map = sensed_hall().map;
  map.origin.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(result.set_map(map), Error);
  map = sensed_hall().map;
  map.cells.pop_back();
  EXPECT_THROW(result.set_map(map), Error);
}

}  // namespace
}  // namespace tagfield
