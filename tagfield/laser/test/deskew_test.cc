// SPDX-License-Identifier: Apache-2.0
#include "tagfield/laser/deskew.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "tagfield/base/units.h"
#include "tagfield/laser/simulated_laser.h"
#include "tagfield/laser/test/plain_room.h"

namespace tagfield {
namespace {

/// A robot on an arc, whose odometry origin differs from the world's.
struct Motion {
  BodyVelocity velocity;
  PlanarPose start_W{-1.0, 0.5, 0.2};
  PlanarPose start_O{30.0, -20.0, 2.0};
  [[nodiscard]] PlanarPose truth(Time time) const {
    return advance(start_W, velocity, to_seconds(time));
  }
  [[nodiscard]] PlanarPose odometry(Time time) const {
    return advance(start_O, velocity, to_seconds(time));
  }
};

LaserParameters swept_laser() {
  LaserParameters laser;
  laser.sigma_m = 0.0;
  laser.sweep_s = 0.025;
  return laser;
}

LaserScan swept_scan(const Scene& scene, const LaserParameters& laser, const Motion& motion,
                     const Obstacles& obstacles = {}) {
  return simulate_scan(
      RayScene(scene), laser, 0, [&](Time time) { return to_transform(motion.truth(time)); },
      [&](Time) { return obstacles; }, 1, 2);
}

LaserScan deskewed(const LaserScan& scan, const LaserParameters& laser, const Motion& motion) {
  return deskewed(
      scan, [&](Time time) { return motion.odometry(time); }, laser.X_RL);
}

/// Position and heading of the scanner at a time.
struct View {
  Eigen::Vector2d p;
  double heading;
  double left = 1.0;  ///< -1 for a scanner upside down.
};

View view_at(const LaserParameters& laser, const Motion& motion, Time time) {
  const RigidTransform X_WL = to_transform(motion.truth(time)) * laser.X_RL;
  const Eigen::Vector3d up = X_WL.rotation * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d forward = X_WL.rotation * Eigen::Vector3d::UnitX();
  return {X_WL.translation.head<2>(), std::atan2(forward.y(), forward.x()),
          up.z() > 0.0 ? 1.0 : -1.0};
}

/// Deviation of a range from the wall's distances within one step of its angle [m]. At grazing
/// incidence and in the room's corners, a scan is no more precise than that.
double beyond_a_step(const LaserScan& scan, std::size_t i, const View& view) {
  double least = 100.0;
  double most = 0.0;
  for (double share = -1.0; share < 1.05; share += 0.1) {
    const double angle = beam_angle(scan, i) + share * scan.angle_step_rad;
    const double truth = to_wall(view.p, view.heading + view.left * angle);
    least = std::min(least, truth);
    most = std::max(most, truth);
  }
  const double range = scan.ranges_m[i];
  return std::max({0.0, least - range, range - most});
}

TEST(Deskew, AWallIsStraightAgain) {
  const LaserParameters laser = swept_laser();
  const Motion motion{{1.5, 3.0}};
  const LaserScan swept = swept_scan(room(), laser, motion);
  const LaserScan scan = deskewed(swept, laser, motion);
  const Time last = swept.stamp + swept.beam_interval * 719;
  EXPECT_EQ(scan.stamp, last);
  EXPECT_EQ(scan.beam_interval, Duration{});
  EXPECT_EQ(scan.first_angle_rad, swept.first_angle_rad);
  EXPECT_EQ(scan.angle_step_rad, swept.angle_step_rad);
  ASSERT_EQ(scan.ranges_m.size(), swept.ranges_m.size());
  const View view = view_at(laser, motion, last);
  double worst_before = 0.0;
  double sum_before = 0.0;
  double sum = 0.0;
  double worst = 0.0;
  int invalid = 0;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double truth = to_wall(view.p, view.heading + beam_angle(scan, i));
    worst_before = std::max(worst_before, std::abs(swept.ranges_m[i] - truth));
    if (beam_of(scan, scan.ranges_m[i]) == Beam::kReturn) {
      worst = std::max(worst, beyond_a_step(scan, i, view));
      sum_before += std::abs(swept.ranges_m[i] - truth);
      sum += std::abs(scan.ranges_m[i] - truth);
    } else {
      ++invalid;
    }
  }
  EXPECT_GT(worst_before, 0.2);
  EXPECT_LT(worst, 1e-4);
  EXPECT_LT(sum, 0.005 * sum_before);
  // It turned left by 0.075 rad: 17 of the last angles, excluding the last one, had no beam.
  EXPECT_LE(invalid, 18);
}

RC_GTEST_PROP(Deskew, WallsAreRightUnderAnyMotion, ()) {
  const auto any = [](double most) { return most * 1e-4 * *rc::gen::inRange(-10000, 10000); };
  LaserParameters laser = swept_laser();
  laser.X_RL = from_xyz_rpy({any(0.3), any(0.3), 0.3},
                            {*rc::gen::arbitrary<bool>() ? kPi : 0.0, 0.0, any(3.0)});
  Motion motion{{any(1.5), any(3.0)}};
  motion.start_W = {any(2.0), any(2.0), any(3.0)};
  const LaserScan swept = swept_scan(room(), laser, motion);
  const LaserScan scan = deskewed(swept, laser, motion);
  const View view = view_at(laser, motion, scan.stamp);
  int invalid = 0;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (beam_of(scan, scan.ranges_m[i]) != Beam::kReturn) {
      ++invalid;
    } else {
      RC_ASSERT(beyond_a_step(scan, i, view) < 1e-3);
    }
  }
  // 3 rad/s and 1.5 m/s at 1 m for 25 ms are 26 steps of the angle.
  RC_ASSERT(invalid <= 40);
}

TEST(Deskew, ARobotAtRestSeesTheSame) {
  const LaserParameters laser = swept_laser();
  const Motion motion{};
  const LaserScan swept = swept_scan(room(), laser, motion);
  const LaserScan scan = deskewed(swept, laser, motion);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    EXPECT_NEAR(scan.ranges_m[i], swept.ranges_m[i], 1e-5) << i;
  }
}

TEST(Deskew, AScanTakenAtOnceStaysAsItIs) {
  LaserParameters laser = swept_laser();
  laser.sweep_s = 0.0;
  laser.sigma_m = 0.01;
  const Motion motion{{1.0, 2.0}};
  const LaserScan at_once = swept_scan(room(), laser, motion);
  const LaserScan scan = deskewed(at_once, laser, motion);
  EXPECT_EQ(scan.ranges_m, at_once.ranges_m);
  EXPECT_EQ(scan.stamp, at_once.stamp);
}

TEST(Deskew, NoPointsAppearBetweenABoxAndTheWallBehind) {
  const LaserParameters laser = swept_laser();
  const Motion motion{{1.5, 3.0}};
  const Obstacles box{{}, {{{1.0, 1.0}, {0.5, 0.7}, 0.6}}};
  const LaserScan scan = deskewed(swept_scan(room(), laser, motion, box), laser, motion);
  const View view = view_at(laser, motion, scan.stamp);
  // The same box, scanned instantaneously.
  LaserParameters still = laser;
  still.sweep_s = 0.0;
  const Motion stopped{{}, motion.truth(scan.stamp), {}};
  const LaserScan truth = swept_scan(room(), still, stopped, box);
  int on_box = 0;
  int wrong = 0;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (beam_of(scan, scan.ranges_m[i]) != Beam::kReturn) continue;
    const double wall = to_wall(view.p, view.heading + beam_angle(scan, i));
    const bool at_wall = std::abs(scan.ranges_m[i] - wall) < 0.02;
    const bool at_box =
        (view.p +
         scan.ranges_m[i] * Eigen::Vector2d(std::cos(view.heading + beam_angle(scan, i)),
                                            std::sin(view.heading + beam_angle(scan, i))) -
         Eigen::Vector2d(1.0, 1.0))
            .norm() < 0.45;
    EXPECT_TRUE(at_wall || at_box) << i;
    on_box += at_box ? 1 : 0;
    wrong += std::abs(scan.ranges_m[i] - truth.ranges_m[i]) > 0.02 ? 1 : 0;
  }
  EXPECT_GT(on_box, 50);
  EXPECT_LE(wrong, 4);  // At the two edges of the box.
}

TEST(Deskew, AThinPoleIsNotLost) {
  // Hit by a beam or two.
  const LaserParameters laser = swept_laser();
  const Motion motion{{1.5, -3.0}};
  const Obstacles pole{{{{1.2, 1.1}, 0.006}}, {}};
  const LaserScan scan = deskewed(swept_scan(room(), laser, motion, pole), laser, motion);
  const View view = view_at(laser, motion, scan.stamp);
  const Eigen::Vector2d to_pole = Eigen::Vector2d(1.2, 1.1) - view.p;
  const double angle = wrap_to_pi(std::atan2(to_pole.y(), to_pole.x()) - view.heading);
  const auto i =
      static_cast<std::size_t>(std::lround((angle - scan.first_angle_rad) / scan.angle_step_rad));
  double nearest = 100.0;
  for (const std::size_t k : {i - 1, i, i + 1}) {
    const float range = scan.ranges_m[k];
    if (beam_of(scan, range) == Beam::kReturn) nearest = std::min<double>(nearest, range);
  }
  EXPECT_NEAR(nearest, to_pole.norm() - 0.006, 0.005);
}

TEST(Deskew, AScannerThatSeesAllRoundSeesAllRound) {
  LaserParameters laser = swept_laser();
  laser.first_angle_rad = -kPi;
  laser.last_angle_rad = kPi - kTwoPi / 1440.0;
  laser.beams = 1440;
  for (const double turn : {3.0, -3.0}) {
    const Motion motion{{0.5, turn}};
    const LaserScan swept = swept_scan(room(), laser, motion);
    const LaserScan scan = deskewed(swept, laser, motion);
    const View view = view_at(laser, motion, scan.stamp);
    int invalid = 0;
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      if (beam_of(scan, scan.ranges_m[i]) != Beam::kReturn) {
        ++invalid;
        continue;
      }
      EXPECT_NEAR(scan.ranges_m[i], to_wall(view.p, view.heading + beam_angle(scan, i)), 0.01) << i;
    }
    // Turning left, the beams overlap; turning right, they leave 0.075 rad, 17 steps, unobserved.
    EXPECT_LE(invalid, 20) << turn;
  }
}

TEST(Deskew, NothingStaysNothing) {
  const LaserParameters laser = swept_laser();
  const Motion motion{{1.0, 2.0}};
  const LaserScan scan = deskewed(swept_scan(Scene{}, laser, motion), laser, motion);
  int nothing = 0;
  for (const float range : scan.ranges_m) {
    const Beam beam = beam_of(scan, range);
    EXPECT_NE(beam, Beam::kReturn);
    if (beam == Beam::kNothing) {
      EXPECT_EQ(range, nothing_range(laser.max_range_m));
      ++nothing;
    }
  }
  EXPECT_GE(nothing, 720 - 14);  // 0.05 rad are 11 steps.
}

TEST(Deskew, InvalidStaysInvalidAndRangesStayInRange) {
  LaserParameters laser = swept_laser();
  laser.min_range_m = 3.5;
  laser.max_range_m = 5.5;
  const Motion motion{{1.5, 1.0}};
  const LaserScan scan = deskewed(swept_scan(room(), laser, motion), laser, motion);
  const View view = view_at(laser, motion, scan.stamp);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double truth = to_wall(view.p, view.heading + beam_angle(scan, i));
    const Beam beam = beam_of(scan, scan.ranges_m[i]);
    // The end points of returns move by up to 4 cm.
    if (truth < 3.4) {
      EXPECT_EQ(beam, Beam::kInvalid) << i;
    }
    if (truth > 5.6) {
      EXPECT_NE(beam, Beam::kReturn) << i;
    }
    if (beam == Beam::kReturn) {
      EXPECT_NEAR(scan.ranges_m[i], truth, 0.01) << i;
    }
  }
}

TEST(Deskew, PosesThatAreNotFiniteGiveInvalidBeams) {
  const LaserParameters laser = swept_laser();
  const Motion motion{{1.0, 2.0}};
  const LaserScan swept = swept_scan(room(), laser, motion);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const LaserScan none = deskewed(
      swept,
      [nan](Time) {
        return PlanarPose{nan, 0.0, 0.0};
      },
      laser.X_RL);
  for (const float range : none.ranges_m) EXPECT_EQ(range, 0.0F);
  const Time half = swept.stamp + swept.beam_interval * 360;
  const LaserScan some = deskewed(
      swept,
      [&](Time t) {
        return t < half ? PlanarPose{0.0, nan, 0.0} : motion.odometry(t);
      },
      laser.X_RL);
  EXPECT_EQ(some.ranges_m[100], 0.0F);
  EXPECT_EQ(beam_of(some, some.ranges_m[600]), Beam::kReturn);
  for (const float range : some.ranges_m) EXPECT_TRUE(std::isfinite(range));
}

TEST(Deskew, AnEmptyScanStaysEmpty) {
  LaserScan empty;
  empty.beam_interval = Duration(1);
  empty.angle_step_rad = 0.1;
  EXPECT_TRUE(deskewed(empty, nullptr, RigidTransform{}).ranges_m.empty());
}

TEST(Deskew, NoiseDoesNotGrow) {
  LaserParameters laser = swept_laser();
  laser.sigma_m = 0.01;
  const Motion motion{{0.8, 1.0}};
  const LaserScan scan = deskewed(swept_scan(room(), laser, motion), laser, motion);
  const View view = view_at(laser, motion, scan.stamp);
  double squares = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (beam_of(scan, scan.ranges_m[i]) != Beam::kReturn) continue;
    const double error = scan.ranges_m[i] - to_wall(view.p, view.heading + beam_angle(scan, i));
    squares += error * error;
    count += 1.0;
  }
  EXPECT_GT(count, 700.0);
  // The mean square of 700 draws is within 1 ± 6·√(2/700) of its expectation.
  EXPECT_LT(squares / count, 1e-4 * 1.33);
}

}  // namespace
}  // namespace tagfield
