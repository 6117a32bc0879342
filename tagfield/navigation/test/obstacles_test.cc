// SPDX-License-Identifier: Apache-2.0
// Drives among people and boxes that are not on the map.

#include <gtest/gtest.h>

#include <cmath>

#include "tagfield/navigation/test/test_worlds.h"

namespace tagfield {
namespace {

using testing::BoxWorld;
using testing::DriveSimulation;
using testing::kLaser;
using testing::simulation_in;
using testing::walls;

/// A wide_hall of 14 m by 14 m, empty.
const BoxWorld& wide_hall() {
  static const BoxWorld world(walls({-2.0, -7.0}, {12.0, 7.0}), {0.0, 0.0});
  return world;
}

/// An aisle 3 m wide between two blocks, and a detour around them.
const BoxWorld& aisle() {
  static const BoxWorld world = [] {
    auto boxes = walls({0.0, 0.0}, {12.0, 10.0});
    boxes.push_back({{3.0, 1.8}, {9.0, 3.5}});
    boxes.push_back({{3.0, 6.5}, {9.0, 10.0}});
    return BoxWorld(boxes, {1.0, 5.0});
  }();
  return world;
}

/// A person who walks straight through `place` at time `at_s`, from 7 m before it to 7 m past it,
/// and yields to nobody.
std::function<Obstacles(Time)> walker(const Eigen::Vector2d& place, double heading, double speed,
                                      double at_s, double radius) {
  const Eigen::Vector2d direction(std::cos(heading), std::sin(heading));
  return [=](Time now) {
    const double way = speed * (to_seconds(now) - at_s);
    Obstacles obstacles;
    if (std::abs(way) < 7.0) obstacles.discs.push_back({place + way * direction, radius});
    return obstacles;
  };
}

struct Crossing {
  double speed;
  double heading_deg;  ///< Of the walker; the robot drives along 0.
};

class Crossings : public ::testing::TestWithParam<Crossing> {};

TEST_P(Crossings, NobodyIsTouched) {
  for (const double phase : {-2.0, -1.0, 0.0, 1.0, 2.0}) {
    // The robot would reach the crossing, 2.5 m ahead, after about 8.7 s.
    GoalDriver driver({}, kLaser);
    driver.set_map(wide_hall().map);
    DriveSimulation simulation = simulation_in(wide_hall(), {0.0, 0.0, 0.0});
    simulation.obstacles_at =
        walker({2.5, 0.0}, radians(GetParam().heading_deg), GetParam().speed, 8.7 + phase, 0.3);
    driver.set_goal({5.0, 0.0, 0.0}, simulation.pose, simulation.now());
    simulation.run(driver, 90.0);
    EXPECT_GT(simulation.min_to_discs_m, 0.0) << phase;
    EXPECT_GT(simulation.min_distance_m, 0.0) << phase;
    EXPECT_EQ(driver.state(), DriveState::kReached) << phase << ": " << driver.reason();
  }
}

INSTANTIATE_TEST_SUITE_P(Walkers, Crossings,
                         ::testing::Values(Crossing{0.5, 90.0}, Crossing{0.5, -135.0},
                                           Crossing{1.0, -90.0}, Crossing{1.0, 120.0},
                                           Crossing{1.0, 180.0}, Crossing{1.5, 90.0},
                                           Crossing{1.5, -120.0}, Crossing{1.5, 165.0}));

TEST(Boxes, OneInTheAisleIsDrivenAround) {
  for (const double y : {4.4, 5.0, 5.7}) {
    GoalDriver driver({}, kLaser);
    driver.set_map(aisle().map);
    DriveSimulation simulation = simulation_in(aisle(), {1.5, 5.0, 0.0});
    simulation.obstacles_at = [&](Time) { return Obstacles{{}, {{{6.0, y}, {0.5, 0.4}, 0.3}}}; };
    driver.set_goal({10.5, 5.0, 0.0}, simulation.pose, simulation.now());
    simulation.run(driver, 120.0);
    EXPECT_EQ(driver.state(), DriveState::kReached) << y << ": " << driver.reason();
    EXPECT_GT(simulation.min_to_boxes_m, 0.05) << y;
    EXPECT_GT(simulation.min_distance_m, 0.05) << y;
    EXPECT_LT(simulation.driven_m, 12.0) << y;
  }
}

TEST(Boxes, ABlockedAisleIsDrivenAround) {
  GoalDriver driver({}, kLaser);
  driver.set_map(aisle().map);
  DriveSimulation simulation = simulation_in(aisle(), {1.5, 5.0, 0.0});
  simulation.obstacles_at = [](Time) { return Obstacles{{}, {{{6.0, 5.0}, {0.5, 2.6}, 0.0}}}; };
  driver.set_goal({10.5, 5.0, 0.0}, simulation.pose, simulation.now());
  simulation.run(driver, 240.0);
  EXPECT_EQ(driver.state(), DriveState::kReached) << driver.reason();
  EXPECT_GT(simulation.min_to_boxes_m, 0.05);
  EXPECT_GT(simulation.min_distance_m, 0.05);
  EXPECT_GT(simulation.driven_m, 12.0);
}

TEST(Boxes, WhereNoWayIsLeftItGivesUpInTime) {
  auto boxes = walls({0.0, 0.0}, {12.0, 3.0});
  const BoxWorld corridor(boxes, {1.0, 1.5});
  GoalDriverSettings settings;
  settings.patience_s = 20.0;
  GoalDriver driver(settings, kLaser);
  driver.set_map(corridor.map);
  DriveSimulation simulation = simulation_in(corridor, {1.0, 1.5, 0.0});
  simulation.obstacles_at = [](Time) { return Obstacles{{}, {{{6.0, 1.5}, {0.5, 2.6}, 0.0}}}; };
  driver.set_goal({10.5, 1.5, 0.0}, simulation.pose, simulation.now());
  simulation.run(driver, 120.0);
  EXPECT_EQ(driver.state(), DriveState::kFailed);
  EXPECT_NE(driver.reason().find("not on the map"), std::string::npos) << driver.reason();
  EXPECT_GT(simulation.min_to_boxes_m, 0.0);
  EXPECT_GT(simulation.min_distance_m, 0.0);
}

TEST(Boxes, WhatIsTakenAwayIsNoHindrance) {
  auto boxes = walls({0.0, 0.0}, {12.0, 3.0});
  const BoxWorld corridor(boxes, {1.0, 1.5});
  GoalDriver driver({}, kLaser);
  driver.set_map(corridor.map);
  DriveSimulation simulation = simulation_in(corridor, {1.0, 1.5, 0.0});
  simulation.obstacles_at = [](Time now) {
    return to_seconds(now) < 30.0 ? Obstacles{{}, {{{6.0, 1.5}, {0.5, 2.6}, 0.0}}} : Obstacles{};
  };
  driver.set_goal({10.5, 1.5, 0.0}, simulation.pose, simulation.now());
  simulation.run(driver, 120.0);
  EXPECT_EQ(driver.state(), DriveState::kReached) << driver.reason();
}

TEST(Boxes, OneOnTheGoalIsNotPushed) {
  GoalDriverSettings settings;
  settings.patience_s = 10.0;
  GoalDriver driver(settings, kLaser);
  driver.set_map(wide_hall().map);
  DriveSimulation simulation = simulation_in(wide_hall(), {0.0, 0.0, 0.0});
  simulation.obstacles_at = [](Time) { return Obstacles{{}, {{{4.0, 0.0}, {0.4, 0.4}, 0.5}}}; };
  driver.set_goal({4.0, 0.0, 0.0}, simulation.pose, simulation.now());
  simulation.run(driver, 120.0);
  EXPECT_EQ(driver.state(), DriveState::kFailed);
  EXPECT_GT(simulation.min_to_boxes_m, 0.0);
}

}  // namespace
}  // namespace tagfield
