// SPDX-License-Identifier: Apache-2.0
#include "tagfield/laser/simulated_laser.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "tagfield/base/test/error_text.h"
#include "tagfield/base/test/statistics.h"
#include "tagfield/base/units.h"
#include "tagfield/laser/test/plain_room.h"

namespace tagfield {
namespace {

LaserParameters exact_laser() {
  LaserParameters laser;
  laser.sigma_m = 0.0;
  return laser;
}

LaserScan scan_from(const Scene& scene, const LaserParameters& laser, const RigidTransform& X_WR,
                    const Obstacles& obstacles = {}, std::int64_t number = 0) {
  return simulate_scan(
      RayScene(scene), laser, number, [&](Time) { return X_WR; }, [&](Time) { return obstacles; },
      1, 2);
}

TEST(SimulatedLaser, SeesTheWallsOfARoomAtAllAngles) {
  LaserParameters laser = exact_laser();
  laser.first_angle_rad = -kPi;
  laser.last_angle_rad = kPi;
  laser.beams = 361;
  const double yaw = 0.4;
  const LaserScan scan = scan_from(room(), laser, from_planar(1.0, -0.5, yaw));
  ASSERT_EQ(scan.ranges_m.size(), 361U);
  // The scanner is 0.15 m in front of the robot's centre.
  const Eigen::Vector2d p(1.0 + 0.15 * std::cos(yaw), -0.5 + 0.15 * std::sin(yaw));
  for (std::size_t i = 0; i < 361; ++i) {
    const double angle = -kPi + radians(static_cast<double>(i));
    EXPECT_NEAR(beam_angle(scan, i), angle, 1e-12);
    EXPECT_NEAR(scan.ranges_m[i], to_wall(p, yaw + angle), 2e-5) << i;
  }
}

RC_GTEST_PROP(SimulatedLaser, SeesTheWallsFromAnywhere, ()) {
  LaserParameters laser = exact_laser();
  laser.min_range_m = 0.0;
  const auto any = [](double low, double high) {
    return low + (high - low) * 1e-4 * *rc::gen::inRange(100, 9900);
  };
  const double yaw = any(-10.0, 10.0);
  laser.X_RL = from_xyz_rpy({0.0, 0.0, 0.3}, {0.0, 0.0, any(-4.0, 4.0)});
  const RigidTransform X_WR = from_planar(any(kWest, kEast), any(kSouth, kNorth), yaw);
  const LaserScan scan = scan_from(room(), laser, X_WR);
  const double heading = yaw + yaw_of(laser.X_RL.rotation);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double expected = to_wall(X_WR.translation.head<2>(), heading + beam_angle(scan, i));
    RC_ASSERT(std::abs(scan.ranges_m[i] - expected) < 1e-4);
  }
}

TEST(SimulatedLaser, UpsideDownItsAnglesGrowToTheRight) {
  LaserParameters laser = exact_laser();
  laser.X_RL = from_xyz_rpy({0.0, 0.0, 0.3}, {kPi, 0.0, 0.0});
  const LaserScan scan = scan_from(room(), laser, {});
  EXPECT_NEAR(scan.ranges_m.front(), kNorth, 1e-4);
  EXPECT_NEAR(scan.ranges_m.back(), -kSouth, 1e-4);
}

TEST(SimulatedLaser, TiltedItSeesTheFloor) {
  Scene scene;
  scene.collisions = {{"ground", Plane{}, {}}};
  LaserParameters laser = exact_laser();
  laser.X_RL = from_xyz_rpy({0.0, 0.0, 1.0}, {0.0, 0.1, 0.0});
  const LaserScan scan = scan_from(scene, laser, {});
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    // Descends by sin(0.1)·cos(angle) per metre.
    const double forward = std::max(std::cos(beam_angle(scan, i)), 1e-9);
    const double expected = 1.0 / (std::sin(0.1) * forward);
    if (expected < 29.9) {
      EXPECT_NEAR(scan.ranges_m[i], expected, 1e-3) << i;
    }
    if (expected > 30.1) {
      EXPECT_EQ(beam_of(scan, scan.ranges_m[i]), Beam::kNothing) << i;
    }
  }
}

TEST(SimulatedLaser, NearAndFarAreSaidAsTheScanSays) {
  LaserParameters laser = exact_laser();
  laser.min_range_m = 3.0;
  laser.max_range_m = 4.5;
  const LaserScan scan = scan_from(room(), laser, from_planar(1.0, -0.5, 0.0));
  std::array<int, 3> seen{};
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double truth = to_wall({1.15, -0.5}, beam_angle(scan, i));
    const Beam beam = beam_of(scan, scan.ranges_m[i]);
    ++seen.at(static_cast<std::size_t>(beam));
    if (truth < 2.999) {
      EXPECT_EQ(scan.ranges_m[i], 0.0F) << i;
    }
    if (truth > 4.501) {
      EXPECT_EQ(beam, Beam::kNothing) << i;
    }
    if (truth > 3.001 && truth < 4.499) {
      EXPECT_NEAR(scan.ranges_m[i], truth, 2e-5) << i;
    }
  }
  for (const int count : seen) EXPECT_GT(count, 50);
}

TEST(SimulatedLaser, NoiseIsGaussianAndIndependent) {
  const LaserParameters laser;  // 720 beams with a sigma of 0.01 m.
  const RayScene world(room());
  std::vector<double> errors;
  std::vector<double> neighbours;
  std::vector<double> next_scan;
  const LaserParameters exact = exact_laser();
  const auto pose_at = [](Time) { return from_planar(0.0, 0.5, 0.0); };
  const LaserScan truth = simulate_scan(world, exact, 0, pose_at, nullptr, 1, 2);
  LaserScan before = simulate_scan(world, laser, 0, pose_at, nullptr, 1, 2);
  for (int number = 1; number <= 30; ++number) {
    const LaserScan scan = simulate_scan(world, laser, number, pose_at, nullptr, 1, 2);
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const std::size_t j = (i + 1) % scan.ranges_m.size();
      errors.push_back((scan.ranges_m[i] - truth.ranges_m[i]) / 0.01);
      neighbours.push_back((scan.ranges_m[j] - truth.ranges_m[j]) / 0.01);
      next_scan.push_back((before.ranges_m[i] - truth.ranges_m[i]) / 0.01);
    }
    before = scan;
  }
  // False-alarm probability: 1e-6 for each of these.
  EXPECT_LT(statistics::kolmogorov(errors, statistics::normal_cdf), statistics::kKolmogorovBound);
  EXPECT_LT(std::abs(statistics::correlation_deviate(errors, neighbours)),
            statistics::kNormalBound);
  EXPECT_LT(std::abs(statistics::correlation_deviate(errors, next_scan)), statistics::kNormalBound);
}

TEST(SimulatedLaser, NoiseTakesNoReturnOutOfTheRange) {
  // A wall at the maximum range, and one at the minimum: about half of the returns are lost.
  for (const bool far : {false, true}) {
    LaserParameters laser;
    laser.sigma_m = 0.1;
    laser.first_angle_rad = -0.001;
    laser.last_angle_rad = 0.001;
    laser.min_range_m = far ? 0.3 : 3.8499;
    laser.max_range_m = far ? 3.8501 : 30.0;
    laser.beams = 10'000;
    const LaserScan scan = scan_from(room(), laser, {});
    int returns = 0;
    for (const float range : scan.ranges_m) {
      const Beam beam = beam_of(scan, range);
      if (beam == Beam::kReturn) ++returns;
      if (beam != Beam::kReturn) {
        EXPECT_EQ(range, far ? nothing_range(3.8501) : 0.0F);
      }
    }
    EXPECT_LT(std::abs(returns - 5000.0) / 50.0, statistics::kNormalBound + 0.1);
  }
}

TEST(SimulatedLaser, TheSameArgumentsGiveTheSameScan) {
  const RayScene world(room());
  const LaserParameters laser;
  const auto scan = [&](std::int64_t number, std::uint64_t seed, std::uint64_t key) {
    return simulate_scan(
               world, laser, number, [](Time) { return RigidTransform{}; }, nullptr, seed, key)
        .ranges_m;
  };
  EXPECT_EQ(scan(3, 1, 2), scan(3, 1, 2));
  EXPECT_NE(scan(3, 1, 2), scan(4, 1, 2));
  EXPECT_NE(scan(3, 1, 2), scan(3, 2, 2));
  EXPECT_NE(scan(3, 1, 2), scan(3, 1, 3));
}

TEST(SimulatedLaser, ABeamsNoiseDoesNotDependOnOtherBeams) {
  // An obstacle that occludes half of the walls leaves the ranges to the other half unchanged.
  const LaserParameters laser;
  const LaserScan without = scan_from(room(), laser, {});
  const LaserScan with = scan_from(room(), laser, {}, {{{{1.0, 1.0}, 0.5}}, {}});
  int same = 0;
  for (std::size_t i = 0; i < with.ranges_m.size(); ++i) {
    same += with.ranges_m[i] == without.ranges_m[i] ? 1 : 0;
  }
  EXPECT_GT(same, 450);
  EXPECT_LT(same, 700);
}

TEST(SimulatedLaser, StampsFollowTheRate) {
  LaserParameters laser;
  EXPECT_EQ(format_stamp(scan_stamp(laser, 0)), "0.000000000");
  EXPECT_EQ(format_stamp(scan_stamp(laser, 1)), "0.033333333");
  EXPECT_EQ(format_stamp(scan_stamp(laser, 2'700'000)), "90000.000000000");
  EXPECT_EQ(scan_from(room(), laser, {}, {}, 90).stamp, Time(std::chrono::seconds(3)));
}

/// A robot that turns and drives in the room.
struct LaserMotion {
  double speed_m_s = 0.0;
  double turn_rad_s = 0.0;
  [[nodiscard]] RigidTransform operator()(Time time) const {
    const double t = to_seconds(time);
    return from_planar(-1.0 + speed_m_s * t, 0.5, 0.2 + turn_rad_s * t);
  }
};

TEST(SimulatedLaser, EachBeamLeavesFromWhereTheScannerIsThen) {
  LaserParameters laser = exact_laser();
  laser.sweep_s = 0.025;
  const LaserMotion motion{1.5, 3.0};
  const std::int64_t number = 7;
  const LaserScan scan = simulate_scan(RayScene(room()), laser, number, motion, nullptr, 1, 2);
  EXPECT_EQ(scan.stamp, scan_stamp(laser, number));
  EXPECT_NEAR(to_seconds(scan.beam_interval), 0.025 / 719.0, 1e-9);
  double max_moved = 0.0;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double t = to_seconds(scan.stamp) + static_cast<double>(i) * 0.025 / 719.0;
    const double yaw = 0.2 + 3.0 * t;
    const Eigen::Vector2d p(-1.0 + 1.5 * t + 0.15 * std::cos(yaw), 0.5 + 0.15 * std::sin(yaw));
    // The beam interval is in whole nanoseconds, so the last beam is up to 0.72 µs early.
    EXPECT_NEAR(scan.ranges_m[i], to_wall(p, yaw + beam_angle(scan, i)), 1e-4) << i;
    const double still = to_seconds(scan.stamp);
    const double yaw_0 = 0.2 + 3.0 * still;
    const Eigen::Vector2d p_0(-1.0 + 1.5 * still + 0.15 * std::cos(yaw_0),
                              0.5 + 0.15 * std::sin(yaw_0));
    max_moved =
        std::max(max_moved, std::abs(scan.ranges_m[i] - to_wall(p_0, yaw_0 + beam_angle(scan, i))));
  }
  EXPECT_GT(max_moved, 0.1);  // Otherwise, this test would show nothing.
}

TEST(SimulatedLaser, AsksForPosesWithinTheSweepAndInOrder) {
  LaserParameters laser;
  laser.sweep_s = 0.02;
  std::vector<Time> asked;
  const auto pose_at = [&asked](Time time) {
    asked.push_back(time);
    return RigidTransform{};
  };
  const LaserScan scan = simulate_scan(RayScene(room()), laser, 5, pose_at, nullptr, 1, 2);
  ASSERT_EQ(asked.size(), 720U);
  EXPECT_TRUE(std::is_sorted(asked.begin(), asked.end()));
  EXPECT_EQ(asked.front(), scan.stamp);
  EXPECT_LE(asked.back(), scan.stamp + std::chrono::milliseconds(20));
  EXPECT_GT(asked.back(), scan.stamp + std::chrono::microseconds(19'999));
}

TEST(SimulatedLaser, SeesADisc) {
  LaserParameters laser = exact_laser();
  laser.X_RL = from_translation({0.0, 0.0, 0.3});
  const Eigen::Vector2d centre(2.0, 0.3);
  const double radius = 0.25;
  const LaserScan scan = scan_from(room(), laser, {}, {{{centre, radius}}, {}});
  const double bearing = std::atan2(centre.y(), centre.x());
  const double half_width = std::asin(radius / centre.norm());
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double off = beam_angle(scan, i) - bearing;
    double expected = to_wall({0.0, 0.0}, beam_angle(scan, i));
    if (std::abs(off) < half_width) {
      // Law of sines in the triangle of scanner, centre and point.
      const double miss = centre.norm() * std::sin(off);
      expected = centre.norm() * std::cos(off) - std::sqrt(radius * radius - miss * miss);
    }
    EXPECT_NEAR(scan.ranges_m[i], expected, 1e-4) << i;
  }
}

/// Distance at which the ray from the origin at `angle` hits a segment, or infinity.
double to_segment(double angle, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d d(std::cos(angle), std::sin(angle));
  const Eigen::Vector2d along = b - a;
  const double determinant = d.x() * along.y() - d.y() * along.x();
  const double t = (a.x() * along.y() - a.y() * along.x()) / determinant;
  const double s = (a.x() * d.y() - a.y() * d.x()) / determinant;
  return t >= 0.0 && s >= 0.0 && s <= 1.0 ? t : std::numeric_limits<double>::infinity();
}

RC_GTEST_PROP(SimulatedLaser, SeesARectangleAsItsFourEdges, ()) {
  LaserParameters laser = exact_laser();
  laser.X_RL = from_translation({0.0, 0.0, 0.3});
  laser.min_range_m = 0.0;
  laser.beams = 90;
  const auto any = [](double most) { return most * 1e-4 * *rc::gen::inRange(-10000, 10000); };
  const Eigen::Vector2d centre(any(3.0), any(3.0));
  const Eigen::Vector2d half(0.05 + std::abs(any(1.0)), 0.05 + std::abs(any(1.0)));
  const double yaw = any(4.0);
  const LaserScan scan = scan_from(Scene{}, laser, {}, {{}, {{centre, 2.0 * half, yaw}}});
  std::vector<Eigen::Vector2d> corners;
  for (const auto& [u, v] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
    const Eigen::Vector2d p(u * half.x(), v * half.y());
    corners.emplace_back(centre.x() + std::cos(yaw) * p.x() - std::sin(yaw) * p.y(),
                         centre.y() + std::sin(yaw) * p.x() + std::cos(yaw) * p.y());
  }
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    double expected = std::numeric_limits<double>::infinity();
    double corner = 1.0;
    for (std::size_t k = 0; k < 4; ++k) {
      const double angle = beam_angle(scan, i);
      expected = std::min(expected, to_segment(angle, corners[k], corners[(k + 1) % 4]));
      const double bearing = std::atan2(corners[k].y(), corners[k].x());
      corner = std::min(corner, std::abs(wrap_to_pi(bearing - angle)));
    }
    if (corner < 1e-5) continue;  // Either answer is right at a corner.
    if (std::isinf(expected)) {
      RC_ASSERT(beam_of(scan, scan.ranges_m[i]) == Beam::kNothing);
    } else if (expected > 1e-6) {
      RC_ASSERT(std::abs(scan.ranges_m[i] - expected) < 1e-3 * (1.0 + expected));
    }
  }
}

TEST(SimulatedLaser, ObstaclesAreTallAndHideBehindWalls) {
  LaserParameters laser = exact_laser();
  laser.X_RL = from_xyz_rpy({0.0, 0.0, 1.0}, {0.0, 0.3, 0.0});
  laser.beams = 3;
  laser.first_angle_rad = -0.1;
  laser.last_angle_rad = 0.1;
  // The middle beam is inclined by 0.3 rad: 2 m horizontally are 2/cos(0.3) along it.
  const Obstacles near{{}, {{{2.5, 0.0}, {1.0, 3.0}, 0.0}}};
  EXPECT_NEAR(scan_from(Scene{}, laser, {}, near).ranges_m[1], 2.0 / std::cos(0.3), 1e-5);
  laser.X_RL = from_translation({0.0, 0.0, 1.0});
  const Obstacles outside{{{{6.0, 0.0}, 1.0}}, {}};
  EXPECT_NEAR(scan_from(room(), laser, {}, outside).ranges_m[1], kEast, 1e-5);
}

TEST(SimulatedLaser, ObstaclesAreWhereTheyAreAtTheBeam) {
  LaserParameters laser = exact_laser();
  laser.sweep_s = 0.03;
  laser.first_angle_rad = -0.05;
  laser.last_angle_rad = 0.05;
  const auto obstacles_at = [](Time time) {
    return Obstacles{{}, {{{3.0 - 10.0 * to_seconds(time), 0.0}, {1.0, 4.0}, 0.0}}};
  };
  const LaserScan scan = simulate_scan(
      RayScene(room()), laser, 0, [](Time) { return RigidTransform{}; }, obstacles_at, 1, 2);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double t = 0.03 * static_cast<double>(i) / 719.0;
    const double expected = (2.5 - 10.0 * t - 0.15) / std::cos(beam_angle(scan, i));
    EXPECT_NEAR(scan.ranges_m[i], expected, 1e-4);
  }
}

TEST(SimulatedLaser, ObstaclesThatAreNotFiniteAreNotThere) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const LaserParameters laser;
  const LaserScan without = scan_from(room(), laser, {});
  for (const double bad : {nan, inf}) {
    const Obstacles obstacles{{{{bad, 0.0}, 1.0}, {{1.0, 0.0}, bad}},
                              {{{bad, 0.0}, {1.0, 1.0}, 0.0},
                               {{1.0, 0.0}, {bad, 1.0}, 0.0},
                               {{1.0, 0.0}, {1.0, 1.0}, bad}}};
    EXPECT_EQ(scan_from(room(), laser, {}, obstacles).ranges_m, without.ranges_m) << bad;
  }
}

TEST(SimulatedLaser, APoseThatIsNotFiniteSeesNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const LaserScan scan = scan_from(room(), {}, from_translation({nan, 0.0, 0.0}));
  for (const float range : scan.ranges_m) EXPECT_EQ(range, nothing_range(30.0));
}

TEST(SimulatedLaser, RefusesBadParameters) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto message = [](auto change) {
    LaserParameters laser;
    change(laser);
    return error_of([&laser] { check(laser); });
  };
  EXPECT_EQ(message([](auto&) {}), "(no error)");
  EXPECT_EQ(message([](auto& l) { l.beams = 1; }), "laser: beams must be 2 to 100000, is 1");
  EXPECT_TRUE(contains(message([](auto& l) { l.beams = 100'001; }), "beams"));
  EXPECT_TRUE(contains(message([nan](auto& l) { l.first_angle_rad = nan; }), "first_angle_rad"));
  EXPECT_TRUE(contains(message([nan](auto& l) { l.last_angle_rad = nan; }), "last_angle_rad"));
  EXPECT_TRUE(contains(message([](auto& l) { l.last_angle_rad = -1.6; }), "last_angle_rad"));
  EXPECT_TRUE(contains(message([](auto& l) { l.last_angle_rad = 5.0; }), "last_angle_rad"));
  EXPECT_TRUE(contains(message([](auto& l) { l.min_range_m = -0.1; }), "min_range_m"));
  EXPECT_TRUE(contains(message([](auto& l) { l.max_range_m = 0.3; }), "max_range_m"));
  EXPECT_TRUE(contains(message([](auto& l) { l.max_range_m = 1e4; }), "max_range_m"));
  EXPECT_TRUE(contains(message([](auto& l) { l.rate_hz = 0.0; }), "rate_hz"));
  EXPECT_TRUE(contains(message([nan](auto& l) { l.rate_hz = nan; }), "rate_hz"));
  EXPECT_TRUE(contains(message([nan](auto& l) { l.sigma_m = nan; }), "sigma_m"));
  EXPECT_TRUE(contains(message([](auto& l) { l.sweep_s = 0.034; }), "sweep_s"));
  EXPECT_TRUE(contains(message([](auto& l) { l.sweep_s = -0.01; }), "sweep_s"));
  EXPECT_TRUE(contains(message([nan](auto& l) { l.X_RL.translation.z() = nan; }), "X_RL"));
  EXPECT_TRUE(contains(message([](auto& l) { l.X_RL.rotation.w() = 2.0; }), "X_RL"));
}

}  // namespace
}  // namespace tagfield
