// SPDX-License-Identifier: Apache-2.0
// How mapper, localizer and driver handle scans and poses that nobody should send them.

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "tagfield/map/true_map.h"
#include "tagfield/navigation/goal_driver.h"
#include "tagfield/navigation/grid_mapper.h"
#include "tagfield/navigation/monte_carlo_localizer.h"
#include "tagfield/navigation/test/room.h"

namespace tagfield {
namespace {

constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();
constexpr double kNever = std::numeric_limits<double>::quiet_NaN();
constexpr double kFar = std::numeric_limits<double>::infinity();

LaserScan scan_from(const PlanarPose& pose, double seconds) {
  static const RayScene rays(room());
  LaserParameters laser;
  laser.beams = 361;
  LaserScan scan = simulate_scan(
      rays, laser, 0, [&](Time) { return to_transform(pose); }, nullptr, 1, 7);
  scan.stamp = time_from_seconds(seconds);
  return scan;
}

struct Odd {
  std::string name;
  LaserScan scan;
};

/// All of these are ignored.
std::vector<Odd> scans_without_meaning() {
  const LaserScan good = scan_from({}, 0.0);
  std::vector<Odd> odd;
  const auto add = [&](const std::string& name, auto change) {
    odd.push_back({name, good});
    change(odd.back().scan);
  };
  add("all NaN", [](LaserScan& scan) { scan.ranges_m.assign(361, kNotANumber); });
  add("no beams", [](LaserScan& scan) { scan.ranges_m.clear(); });
  add("no returns", [](LaserScan& scan) { scan.ranges_m.assign(361, 31.0F); });
  add("infinite",
      [](LaserScan& scan) { scan.ranges_m.assign(361, std::numeric_limits<float>::infinity()); });
  add("all invalid", [](LaserScan& scan) { scan.ranges_m.assign(361, 0.0F); });
  add("negative", [](LaserScan& scan) { scan.ranges_m.assign(361, -1.0F); });
  add("angle NaN", [](LaserScan& scan) { scan.first_angle_rad = kNever; });
  add("steps infinite", [](LaserScan& scan) { scan.angle_step_rad = kFar; });
  add("ranges NaN", [](LaserScan& scan) { scan.min_range_m = scan.max_range_m = kNever; });
  return odd;
}

/// Some beams are NaN, infinite or negative; the rest are valid.
LaserScan scan_with_holes(const PlanarPose& pose, double seconds) {
  LaserScan scan = scan_from(pose, seconds);
  for (std::size_t i = 0; i < scan.ranges_m.size(); i += 10) scan.ranges_m[i] = kNotANumber;
  for (std::size_t i = 5; i < scan.ranges_m.size(); i += 30) scan.ranges_m[i] = -2.0F;
  return scan;
}

/// Every third beam only, as from another laser.
LaserScan scan_with_fewer_beams(const PlanarPose& pose, double seconds) {
  LaserScan scan = scan_from(pose, seconds);
  std::vector<float> kept;
  for (std::size_t i = 0; i < scan.ranges_m.size(); i += 3) kept.push_back(scan.ranges_m[i]);
  scan.ranges_m = kept;
  scan.angle_step_rad *= 3.0;
  return scan;
}

TEST(GridMapper, PassesOverScansWithoutMeaning) {
  GridMapper mapper({}, LaserParameters{}.X_RL, {}, 1);
  for (const Odd& odd : scans_without_meaning()) {
    EXPECT_FALSE(mapper.update(odd.scan, {})) << odd.name;
  }
  for (const std::int8_t cell : mapper.map().cells) EXPECT_LT(cell, 0);
  ASSERT_TRUE(mapper.update(scan_from({}, 0.0), {}));
  const std::vector<std::int8_t> before = mapper.map().cells;
  for (const Odd& odd : scans_without_meaning()) {
    EXPECT_FALSE(mapper.update(odd.scan, {1.0, 0.0, 0.0})) << odd.name;
  }
  EXPECT_EQ(mapper.map().cells, before);
}

TEST(GridMapper, GoesOnAfterOddScans) {
  GridMapper mapper({}, LaserParameters{}.X_RL, {}, 1);
  PlanarPose pose;
  for (int i = 0; i < 20; ++i, pose.x += 0.1) {
    // Timestamps that go back don't matter: the order of calls does.
    const double stamp = -0.5 * i;
    mapper.update(i % 3 == 0   ? scan_with_holes(pose, stamp)
                  : i % 3 == 1 ? scan_with_fewer_beams(pose, stamp)
                               : scan_from(pose, stamp),
                  pose);
    EXPECT_LT(distance(mapper.pose_at(pose), pose), 0.03);
  }
}

OccupancyGrid whole_map() { return true_map(room(), 0.31, {0.0, 0.0}, 0.05); }

MonteCarloLocalizer localizer_at(const PlanarPose& start) {
  MonteCarloLocalizer localizer(whole_map(), {}, LaserParameters{}.X_RL, 1);
  localizer.start_at({start, Eigen::Vector3d(0.0025, 0.0025, 0.0025).asDiagonal()});
  return localizer;
}

TEST(MonteCarloLocalizer, PassesOverWhatHasNoMeaning) {
  MonteCarloLocalizer localizer = localizer_at({});
  for (const Odd& odd : scans_without_meaning()) {
    EXPECT_FALSE(localizer.update(odd.scan, {})) << odd.name;
  }
  for (const PlanarPose& odometry :
       {PlanarPose{kNever, 0.0, 0.0}, {0.0, kFar, 0.0}, {0.0, 0.0, kNever}}) {
    EXPECT_FALSE(localizer.update(scan_from({}, 0.0), odometry));
  }
  // None of that has left a trace.
  PlanarPose pose;
  for (int i = 0; i < 8; ++i, pose.x += 0.15) {
    EXPECT_TRUE(localizer.update(scan_from(pose, 0.1 * i), pose));
  }
  EXPECT_LT(distance(localizer.estimate_at(pose).pose_M, pose), 0.03);
  EXPECT_EQ(localizer.state(), Localization::kTracking);
}

TEST(MonteCarloLocalizer, TakesScansWithHolesOtherBeamsAndOldStamps) {
  MonteCarloLocalizer localizer = localizer_at({});
  PlanarPose pose;
  for (int i = 0; i < 9; ++i, pose.x += 0.15) {
    const double stamp = 5.0 - i;
    EXPECT_TRUE(localizer.update(i % 3 == 0   ? scan_with_holes(pose, stamp)
                                 : i % 3 == 1 ? scan_with_fewer_beams(pose, stamp)
                                              : scan_from(pose, stamp),
                                 pose));
  }
  EXPECT_LT(distance(localizer.estimate_at(pose).pose_M, pose), 0.03);
}

/// Drives towards a goal ahead for a second, with the scans from `scan_at`.
BodyVelocity driven(GoalDriver& driver, PlanarPose& pose, double from_s,
                    const std::function<LaserScan(const PlanarPose&, double)>& scan_at) {
  BodyVelocity velocity;
  for (int i = 0; i < 20; ++i) {
    const double now = from_s + 0.05 * i;
    driver.see(scan_at(pose, now), pose);
    velocity = limited(driver.next(pose, velocity, time_from_seconds(now)), velocity, {}, 0.05);
    pose = advance(pose, velocity, 0.05);
  }
  return velocity;
}

GoalDriver driver_to(const PlanarPose& goal, double now_s = 0.0) {
  GoalDriver driver({}, LaserParameters{}.X_RL);
  driver.set_map(whole_map());
  driver.set_goal(goal, {}, time_from_seconds(now_s));
  return driver;
}

TEST(GoalDriver, StandsWhereScansHaveNoMeaning) {
  for (const Odd& odd : scans_without_meaning()) {
    // To a driver, that nothing is within range is valid information.
    if (odd.name == "no returns" || odd.name == "infinite") continue;
    GoalDriver driver = driver_to({2.0, 0.0, 0.0});
    PlanarPose pose;
    const BodyVelocity velocity = driven(driver, pose, 0.0, [&](const PlanarPose&, double now) {
      LaserScan scan = odd.scan;
      scan.stamp = time_from_seconds(now);
      return scan;
    });
    EXPECT_EQ(velocity.forward, 0.0) << odd.name;
    EXPECT_EQ(pose.x, 0.0) << odd.name;
    // It drives on once scans are valid.
    EXPECT_GT(driven(driver, pose, 1.0, scan_from).forward, 0.2) << odd.name;
  }
}

TEST(GoalDriver, DrivesByScansWithHolesOrOtherBeams) {
  GoalDriver driver = driver_to({2.0, 0.0, 0.0});
  PlanarPose pose;
  EXPECT_GT(driven(driver, pose, 0.0, scan_with_holes).forward, 0.2);
  EXPECT_GT(driven(driver, pose, 1.0, scan_with_fewer_beams).forward, 0.2);
}

TEST(GoalDriver, GoesOnWhenTimeGoesBack) {
  GoalDriver driver = driver_to({2.5, 0.0, 0.0}, 1000.0);
  PlanarPose pose;
  EXPECT_GT(driven(driver, pose, 1000.0, scan_from).forward, 0.2);
  EXPECT_GT(driven(driver, pose, 3.0, scan_from).forward, 0.0);
  EXPECT_EQ(driver.state(), DriveState::kDriving);
  // Outdated scans count as none.
  const auto old = [](const PlanarPose& at, double now) { return scan_from(at, now - 2.0); };
  EXPECT_EQ(driven(driver, pose, 4.0, old).forward, 0.0);
}

TEST(GoalDriver, RefusesGoalsAndPosesThatAreNotFinite) {
  for (const PlanarPose& goal : {PlanarPose{kNever, 0.0, 0.0}, {0.0, kFar, 0.0}, {0, 0, kNever}}) {
    const GoalDriver driver = driver_to(goal);
    EXPECT_EQ(driver.state(), DriveState::kRefused);
    EXPECT_EQ(driver.reason(), "the goal is not finite");
  }
  GoalDriver driver = driver_to({2.0, 0.0, 0.0});
  PlanarPose pose;
  driven(driver, pose, 0.0, scan_from);
  EXPECT_EQ(driver.next({kNever, 0.0, 0.0}, {}, time_from_seconds(1.0)).forward, 0.0);
  EXPECT_EQ(driver.state(), DriveState::kDriving);
}

}  // namespace
}  // namespace tagfield
