// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/local_planner.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tagfield/motion/planar_pose.h"
#include "tagfield/navigation/test/test_worlds.h"

namespace tagfield {
namespace {

using testing::room_of;

/// Decides in the middle of an empty room of 20 m by 20 m with points and people in it.
struct Place {
  LocalSettings settings;
  OccupancyGrid map = room_of(20.0, 20.0);
  std::vector<Eigen::Vector2d> points;
  std::vector<MovingObstacle> moving;
  PlanarPose pose{10.0, 10.0, 0.0};
  BodyVelocity present;
  std::optional<Decision> last;
  bool is_known_behind = true;

  Decision decide_on(const BodyVelocity& wanted) {
    const DistanceWindow window(map, points, position_of(pose), window_half(settings), 0.76);
    double clear = 1.0;
    for (const Eigen::Vector2d& point : points) {
      clear = std::min(clear, (point - position_of(pose)).norm());
    }
    const Surroundings around{&window, clear, moving,
                              [&](const Eigen::Vector2d&) { return is_known_behind; }};
    return decide(pose, present, wanted, around, last, settings);
  }

  /// Drives for `seconds`, deciding every 50 ms; records the least gaps to points and people.
  void drive(const std::function<BodyVelocity(const PlanarPose&)>& wanted, double seconds) {
    for (int i = 0; i < std::lround(20.0 * seconds); ++i) {
      last = decide_on(wanted(pose));
      present = last->command;
      pose = advance(pose, present, 0.05);
      for (MovingObstacle& walker : moving) {
        walker.centre_M = walker.at(0.05);
        const double distance = (walker.centre_M - position_of(pose)).norm();
        min_gap = std::min(min_gap, distance - walker.radius_m - settings.size.radius_m);
      }
      for (const Eigen::Vector2d& point : points) {
        min_clear = std::min(min_clear, (point - position_of(pose)).norm());
      }
    }
  }
  double min_gap = 1e9;
  double min_clear = 1e9;
};

TEST(LocalPlanner, DrivesWhatIsWantedInTheOpen) {
  Place place;
  place.present = {0.3, 0.1};
  const Decision decision = place.decide_on({0.3, 0.1});
  EXPECT_EQ(decision.command.forward, 0.3);
  EXPECT_EQ(decision.command.turn, 0.1);
  EXPECT_EQ(decision.hindrance, Hindrance::kNone);
  EXPECT_FALSE(decision.is_evading);
}

TEST(LocalPlanner, AcceleratesAsTheDriveCan) {
  Place place;
  const Decision decision = place.decide_on({0.3, 0.5});
  EXPECT_NEAR(decision.command.forward, 0.05, 1e-12);
  EXPECT_NEAR(decision.command.turn, 0.15, 1e-12);
}

TEST(LocalPlanner, StopsBeforeAWall) {
  Place place;
  for (int i = -40; i <= 40; ++i) place.points.emplace_back(11.0, 10.0 + 0.05 * i);
  // Wants to go straight on, whatever happens.
  place.drive([](const PlanarPose& pose) { return BodyVelocity{0.3, -2.0 * pose.yaw}; }, 10.0);
  EXPECT_GT(place.min_clear, 0.36);
  EXPECT_LT(place.min_clear, 0.6);
  EXPECT_EQ(place.last->hindrance, Hindrance::kStanding);
}

TEST(LocalPlanner, BrakesFromFullSpeed) {
  Place place;
  place.present = {0.8, 0.0};
  for (int i = -40; i <= 40; ++i) place.points.emplace_back(11.0, 10.0 + 0.05 * i);
  place.drive([](const PlanarPose&) { return BodyVelocity{0.8, 0.0}; }, 5.0);
  EXPECT_GT(place.min_clear, 0.36);
}

TEST(LocalPlanner, DoesNotBackOverUnknownGround) {
  Place place;
  place.is_known_behind = false;
  EXPECT_EQ(place.decide_on({-0.15, 0.0}).command.forward, 0.0);
  place.is_known_behind = true;
  EXPECT_LT(place.decide_on({-0.15, 0.0}).command.forward, 0.0);
}

TEST(LocalPlanner, LetsWhoCrossesPass) {
  Place place;
  place.moving = {{{12.0, 6.0}, {0.0, 1.0}, 0.3}};
  place.drive([](const PlanarPose& pose) { return BodyVelocity{0.3, -2.0 * pose.yaw}; }, 12.0);
  EXPECT_GT(place.min_gap, 0.0);
  EXPECT_GT(place.pose.x, 11.0);  // It went on after that.
}

TEST(LocalPlanner, GetsOutOfTheWayOfWhoComesAtIt) {
  for (const double heading : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0}) {
    Place place;
    place.pose.yaw = heading;
    place.moving = {{{14.5, 10.0}, {-1.5, 0.0}, 0.3}};
    place.drive([](const PlanarPose&) { return BodyVelocity{}; }, 8.0);
    EXPECT_GT(place.min_gap, 0.0) << heading;
    EXPECT_EQ(place.present.forward, 0.0) << heading;
  }
}

TEST(LocalPlanner, SaysThatSomebodyIsInTheWay) {
  Place place;
  place.moving = {{{11.0, 9.0}, {0.0, 0.5}, 0.3}};
  EXPECT_EQ(place.decide_on({0.3, 0.0}).hindrance, Hindrance::kMoving);
}

TEST(LocalPlanner, WhoStandsTooNearMayOnlyLeaveInWideArcs) {
  Place place;
  for (int i = -40; i <= 40; ++i) place.points.emplace_back(10.0 + 0.05 * i, 9.68);
  // Turning on the spot would swing a corner into the wall.
  const Decision decision = place.decide_on({0.0, 1.0});
  EXPECT_NE(decision.command.forward, 0.0);
  EXPECT_LT(std::abs(decision.manoeuvre.first.turn), 0.31);
  place.drive([](const PlanarPose& pose) { return BodyVelocity{0.0, 1.5 - pose.yaw}; }, 10.0);
  EXPECT_NEAR(place.pose.yaw, 1.5, 0.1);
  EXPECT_GT(place.min_clear, 0.3);
}

RC_GTEST_PROP(LocalPlannerProperties, CommandsAreWithinTheDrivesReach, ()) {
  Place place;
  const auto draw = [](double low, double high) {
    return low + *rc::gen::inRange(0, 1001) * 0.001 * (high - low);
  };
  for (int i = *rc::gen::inRange(0, 20); i > 0; --i) {
    place.points.emplace_back(draw(8.0, 12.0), draw(8.0, 12.0));
  }
  for (int i = *rc::gen::inRange(0, 3); i > 0; --i) {
    place.moving.push_back(
        {{draw(6.0, 14.0), draw(6.0, 14.0)}, {draw(-1.5, 1.5), draw(-1.5, 1.5)}, draw(0.2, 0.4)});
  }
  place.present = {draw(-0.8, 0.8), draw(-1.5, 1.5)};
  const Decision decision = place.decide_on({draw(-0.3, 0.3), draw(-1.0, 1.0)});
  RC_ASSERT(std::isfinite(decision.command.forward) && std::isfinite(decision.command.turn));
  RC_ASSERT(std::abs(decision.command.forward - place.present.forward) <= 0.05 + 1e-9);
  RC_ASSERT(std::abs(decision.command.turn - place.present.turn) <= 0.15 + 1e-9);
  RC_ASSERT(std::abs(decision.command.forward) <= 0.8 + 1e-9);
  RC_ASSERT(std::abs(decision.command.turn) <= 1.5 + 1e-9);
}

}  // namespace
}  // namespace tagfield
