// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/wander.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tagfield/base/random.h"
#include "tagfield/navigation/test/test_worlds.h"

namespace tagfield {
namespace {

using testing::BoxWorld;
using testing::DriveSimulation;
using testing::simulation_in;

/// Distance at which a disc that advances millimetre by millimetre first touches a point.
double way_by_steps(const std::vector<Eigen::Vector2d>& points, double angle, double half_width,
                    double most) {
  const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
  std::vector<Eigen::Vector2d> outside;
  for (const Eigen::Vector2d& p : points) {
    if (p.norm() > half_width) outside.push_back(p);
  }
  for (double way = 0.0; way < most; way += 1e-3) {
    for (const Eigen::Vector2d& p : outside) {
      if ((p - way * along).norm() < half_width) return way;
    }
  }
  return most;
}

TEST(OpenWay, IsWhereADiscMeetsTheFirstPoint) {
  RandomStream stream(3, Purpose::kPlaces);
  for (int i = 0; i < 40; ++i) {
    std::vector<Eigen::Vector2d> points;
    for (int j = 0; j < 12; ++j) {
      const auto [x, y] = standard_normal_pair(stream);
      points.emplace_back(1.5 * x, 1.5 * y);
    }
    const double angle = 0.3 * i;
    EXPECT_NEAR(free_distance(points, angle, 0.45, 3.0), way_by_steps(points, angle, 0.45, 3.0),
                2e-3);
  }
}

TEST(OpenWay, EndsAtMost) {
  EXPECT_EQ(free_distance({}, 1.0, 0.4, 4.0), 4.0);
  EXPECT_EQ(free_distance({{-1.0, 0.0}, {1.0, 0.41}}, 0.0, 0.4, 4.0), 4.0);
  EXPECT_NEAR(free_distance({{2.0, 0.0}}, 0.0, 0.4, 4.0), 1.6, 1e-12);
  EXPECT_NEAR(free_distance({{2.0, 0.24}}, 0.0, 0.4, 4.0), 2.0 - 0.32, 1e-12);
  // Covered already: the robot stands beside it, and may leave.
  EXPECT_EQ(free_distance({{0.3, 0.0}}, 0.0, 0.4, 4.0), 4.0);
}

/// A room of 7 m by 5 m with two boxes.
const BoxWorld& room() {
  static const BoxWorld world = [] {
    auto boxes = testing::walls({0.0, 0.0}, {7.0, 5.0});
    boxes.push_back({{3.0, 0.0}, {3.6, 2.2}});
    boxes.push_back({{5.4, 3.6}, {7.0, 4.2}});
    return BoxWorld(boxes, {1.0, 1.0});
  }();
  return world;
}

/// One step of a sixtieth of a second; the odometry starts at zero and drifts.
void advance_by(Wander& wander, DriveSimulation& simulation, PlanarPose& odometry) {
  const double dt = 1.0 / DriveSimulation::kStepsPerSecond;
  if (simulation.step % 2 == 0) {
    const RigidTransform X_WR = to_transform(simulation.pose);
    wander.see(simulate_scan(
                   *simulation.world, simulation.laser, simulation.step / 2,
                   [&](Time) { return X_WR; }, simulation.obstacles_at, simulation.seed, 7),
               odometry);
  }
  const BodyVelocity wanted = wander.next(odometry, simulation.velocity, simulation.now());
  simulation.velocity = limited(wanted, simulation.velocity, simulation.limits, dt);
  simulation.pose = advance(simulation.pose, simulation.velocity, dt);
  const BodyVelocity measured{1.01 * simulation.velocity.forward,
                              1.01 * simulation.velocity.turn + 1e-3};
  odometry = advance(odometry, measured, dt);
  simulation.driven_m += std::abs(simulation.velocity.forward) * dt;
  ++simulation.step;
  simulation.measure();
}

DriveSimulation simulation_from(const PlanarPose& start) {
  DriveSimulation simulation = simulation_in(room(), start);
  simulation.laser.beams = 181;
  return simulation;
}

class Wanders : public ::testing::TestWithParam<PlanarPose> {};

TEST_P(Wanders, AroundAndTouchNothing) {
  DriveSimulation simulation = simulation_from(GetParam());
  Wander wander({}, simulation.laser.X_RL);
  PlanarPose odometry;
  double turned = 0.0;
  double turned_before_leaving = 0.0;
  while (simulation.step < std::int64_t{60} * DriveSimulation::kStepsPerSecond) {
    advance_by(wander, simulation, odometry);
    turned += std::abs(simulation.velocity.turn) / DriveSimulation::kStepsPerSecond;
    if (simulation.driven_m < 0.1) turned_before_leaving = turned;
  }
  EXPECT_GT(turned_before_leaving, radians(330.0));
  EXPECT_GT(simulation.min_distance_m, 0.0);
  EXPECT_GT(simulation.driven_m, 5.0);
  // It gets around instead of going to and fro.
  double farthest = 0.0;
  for (const PlanarPose& pose : simulation.trail) {
    farthest = std::max(farthest, (position_of(pose) - position_of(GetParam())).norm());
  }
  EXPECT_GT(farthest, 2.5);
}

TEST(Wander, DoesNotHeedWhatItStandsOn) {
  DriveSimulation simulation = simulation_from({1.5, 1.2, 0.0});
  Wander wander({}, simulation.laser.X_RL);
  PlanarPose odometry;
  std::vector<Eigen::Vector2d> everywhere_O;
  for (double x = -6.0; x <= 6.0; x += 0.1) {
    for (double y = -6.0; y <= 6.0; y += 0.1) everywhere_O.emplace_back(x, y);
  }
  while (simulation.step < std::int64_t{20} * DriveSimulation::kStepsPerSecond) {
    wander.mind(everywhere_O);
    advance_by(wander, simulation, odometry);
  }
  EXPECT_GT(simulation.driven_m, 1.0);
}

/// In a corner, nearer to its walls than a goal may be, and facing into it.
TEST(Wander, ComesOutOfACorner) {
  DriveSimulation simulation = simulation_from({0.39, 0.39, -2.36});
  Wander wander({}, simulation.laser.X_RL);
  PlanarPose odometry;
  while (simulation.step < std::int64_t{40} * DriveSimulation::kStepsPerSecond) {
    advance_by(wander, simulation, odometry);
  }
  EXPECT_GT(simulation.driven_m, 3.0);
  EXPECT_GT(simulation.min_distance_m, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Room, Wanders,
                         ::testing::Values(PlanarPose{1.0, 1.0, 0.0}, PlanarPose{6.2, 1.0, 2.0},
                                           PlanarPose{6.3, 3.0, -1.0}, PlanarPose{2.4, 0.6, 1.57}));

/// A low board across the room that the laser does not see: the robot stays on its side.
TEST(Wander, MindsWhatItIsWarnedOf) {
  DriveSimulation simulation = simulation_from({1.5, 1.2, 0.0});
  const PlanarPose start = simulation.pose;
  Wander wander({}, simulation.laser.X_RL);
  PlanarPose odometry;
  std::vector<Eigen::Vector2d> board_O;
  for (double y = 0.0; y <= 5.0; y += 0.05) {
    const PlanarPose p_O = between(start, {2.8, y, 0.0});
    board_O.emplace_back(p_O.x, p_O.y);
  }
  double rightmost = 0.0;
  while (simulation.step < std::int64_t{40} * DriveSimulation::kStepsPerSecond) {
    wander.mind(board_O);
    advance_by(wander, simulation, odometry);
    rightmost = std::max(rightmost, simulation.pose.x);
  }
  EXPECT_GT(simulation.driven_m, 2.0);
  EXPECT_LT(rightmost, 2.8 - 0.36);
}

/// With a 360° view: nobody approaches from a direction it does not see.
TEST(Wander, LetsSomebodyPass) {
  DriveSimulation simulation = simulation_from({1.5, 2.5, 0.0});
  simulation.laser.beams = 360;
  simulation.laser.first_angle_rad = -kPi;
  simulation.laser.last_angle_rad = kPi - radians(1.0);
  simulation.obstacles_at = [](Time now) {
    // To and fro across the room at 0.8 m/s.
    const double phase = std::fmod(0.8 * to_seconds(now), 8.0);
    return Obstacles{{{{2.4, 0.5 + (phase < 4.0 ? phase : 8.0 - phase)}, 0.25}}, {}};
  };
  Wander wander({}, simulation.laser.X_RL);
  PlanarPose odometry;
  while (simulation.step < std::int64_t{30} * DriveSimulation::kStepsPerSecond) {
    advance_by(wander, simulation, odometry);
  }
  EXPECT_GT(simulation.min_distance_m, 0.0);
  EXPECT_GT(simulation.min_to_discs_m, 0.0);
}

TEST(Wander, StandsWithoutAScanOrAPose) {
  Wander wander({}, from_translation({0.15, 0.0, 0.31}));
  EXPECT_EQ(wander.next({}, {}, Time{}).turn, 0.0);
  DriveSimulation simulation = simulation_from({1.0, 1.0, 0.0});
  const RigidTransform X_WR = to_transform(simulation.pose);
  const LaserScan scan = simulate_scan(
      room().rays, simulation.laser, 0, [&](Time) { return X_WR; }, nullptr, 1, 7);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  wander.see(scan, {nan, 0.0, 0.0});
  EXPECT_EQ(wander.next({}, {}, Time{}).turn, 0.0);
  wander.see(scan, {});
  EXPECT_EQ(wander.next({0.0, nan, 0.0}, {}, Time{}).turn, 0.0);
  EXPECT_GT(wander.next({}, {}, Time{}).turn, 0.0);
  // The scan grows old.
  EXPECT_EQ(wander.next({}, {}, time_from_seconds(1.0)).turn, 0.0);
  wander.begin();
  EXPECT_EQ(wander.next({}, {}, Time{}).turn, 0.0);
}

}  // namespace
}  // namespace tagfield
