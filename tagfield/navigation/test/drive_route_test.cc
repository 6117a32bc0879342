// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/drive_route.h"

#include <gtest/gtest.h>

#include "tagfield/navigation/test/test_worlds.h"

namespace tagfield {
namespace {

using testing::BoxWorld;
using testing::kLaser;
using testing::paint;
using testing::walls;

const PlanarPose kStart{1.0, 3.0, 0.0};
const PlanarPose kGoal{9.0, 3.0, 0.0};

const BoxWorld& empty_hall() {
  static const BoxWorld world(walls({0.0, 0.0}, {10.0, 6.0}), {1.0, 1.0});
  return world;
}

/// Senses after seeing the empty_hall with `obstacles` for a second from `kStart`.
DriveSenses senses_with(const Obstacles& obstacles) {
  DriveSenses senses(kLaser, 0.36);
  senses.set_map(empty_hall().map);
  const RigidTransform X_WR = to_transform(kStart);
  for (int i = 0; i <= 30; ++i) {
    senses.see(simulate_scan(
                   empty_hall().rays, {}, i, [&](Time) { return X_WR; },
                   [&](Time) { return obstacles; }, 1, 1),
               kStart);
  }
  return senses;
}

Time at_second(double seconds) { return time_from_seconds(seconds); }

double farthest_aside(const DriveRoute& route) {
  double most = 0.0;
  for (const Eigen::Vector2d& p : route.way()) most = std::max(most, std::abs(p.y() - 3.0));
  return most;
}

TEST(DriveRoute, BeginsAndClears) {
  const DriveSenses senses = senses_with({});
  DriveRoute route({}, {});
  EXPECT_EQ(route.begin(senses, kStart, kGoal, at_second(0.0)), "");
  EXPECT_NEAR(route.pursuit().remaining_m(), 8.0, 0.1);
  EXPECT_NE(route.begin(senses, kStart, {50.0, 3.0, 0.0}, at_second(0.0)), "");
  EXPECT_TRUE(route.way().empty());
  route.clear();
  EXPECT_EQ(route.refusal(), "");
}

TEST(DriveRoute, GoesRoundWhatStandsThereForAWhile) {
  const DriveSenses empty = senses_with({});
  const DriveSenses boxed = senses_with({{}, {{{3.5, 3.0}, {0.5, 0.5}, 0.0}}});
  DriveRoute route({}, {});
  ASSERT_EQ(route.begin(empty, kStart, kGoal, at_second(0.0)), "");
  EXPECT_LT(farthest_aside(route), 0.1);
  EXPECT_FALSE(route.follow(boxed, kStart, at_second(2.0)));
  EXPECT_FALSE(route.follow(boxed, kStart, at_second(2.4)));
  EXPECT_TRUE(route.follow(boxed, kStart, at_second(2.6)));
  EXPECT_GT(farthest_aside(route), 0.6);
  ASSERT_TRUE(route.block_M());
  EXPECT_NEAR(route.block_M()->x(), 3.25, 0.1);
  // The new path is free.
  EXPECT_FALSE(route.follow(boxed, kStart, at_second(9.0)));
  EXPECT_FALSE(route.follow(boxed, kStart, at_second(10.0)));
}

TEST(DriveRoute, WhatIsSeenOverAllTheWidthIsNoRefusal) {
  const DriveSenses closed = senses_with({{}, {{{3.5, 3.0}, {0.5, 5.8}, 0.0}}});
  DriveRoute route({}, {});
  EXPECT_EQ(route.begin(closed, kStart, kGoal, at_second(0.0)), "");
  EXPECT_LT(farthest_aside(route), 0.1);
}

TEST(DriveRoute, PlansAnewFarOffItsWay) {
  const DriveSenses senses = senses_with({});
  DriveRoute route({}, {});
  ASSERT_EQ(route.begin(senses, kStart, kGoal, at_second(0.0)), "");
  EXPECT_FALSE(route.follow(senses, {1.2, 3.4, 0.0}, at_second(5.0)));
  EXPECT_TRUE(route.follow(senses, {1.2, 3.7, 0.0}, at_second(5.0)));
  EXPECT_EQ(route.way().front(), Eigen::Vector2d(1.2, 3.7));
  EXPECT_FALSE(route.follow(senses, {1.2, 3.0, 0.0}, at_second(5.5)));  // Too soon.
}

TEST(DriveRoute, PlansAnewOnANewMapAndKeepsItsWayIfItMust) {
  DriveSenses senses = senses_with({});
  DriveRoute route({}, {});
  ASSERT_EQ(route.begin(senses, kStart, kGoal, at_second(0.0)), "");
  OccupancyGrid map = empty_hall().map;
  paint(map, {5.0, 2.0}, {5.5, 6.0}, 100);
  senses.set_map(map);
  route.map_changed();
  EXPECT_TRUE(route.follow(senses, kStart, at_second(2.0)));
  EXPECT_GT(farthest_aside(route), 1.4);
  paint(map, {5.0, 0.0}, {5.5, 6.0}, 100);
  senses.set_map(map);
  route.map_changed();
  EXPECT_FALSE(route.follow(senses, kStart, at_second(4.0)));
  EXPECT_NE(route.refusal().find("no path"), std::string::npos);
  EXPECT_GT(farthest_aside(route), 1.4);
}

}  // namespace
}  // namespace tagfield
