// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/monte_carlo_localizer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <thread>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/map/true_map.h"
#include "tagfield/navigation/test/room.h"

namespace tagfield {
namespace {

OccupancyGrid map_of_room() {
  return true_map(room(), LaserParameters{}.X_RL.translation.z(), position_of(loop().start), 0.05);
}

MonteCarloLocalizer localizer(std::uint64_t seed) {
  return {map_of_room(), LocalizerSettings{}, LaserParameters{}.X_RL, seed};
}

PoseEstimate roughly(const PlanarPose& pose) {
  return {pose, Eigen::Vector3d(0.0025, 0.0025, 0.0025).asDiagonal()};
}

/// Errors of the estimate at all scans after the first metre.
std::vector<double> errors_on_loop(MonteCarloLocalizer& localizer, std::uint64_t seed) {
  std::vector<double> errors;
  int scans = 0;
  sense(room(), loop(), {}, seed,
        [&](const LaserScan& scan, const PlanarPose& odometry, const PlanarPose& truth) {
          localizer.update(scan, odometry);
          if (++scans < 400) return;
          errors.push_back(distance(localizer.estimate_at(odometry).pose_M, truth));
        });
  std::sort(errors.begin(), errors.end());
  return errors;
}

TEST(MonteCarloLocalizer, FollowsFromAKnownStart) {
  MonteCarloLocalizer known = localizer(1);
  known.start_at(roughly(loop().start));
  EXPECT_EQ(known.state(), Localization::kTracking);
  const std::vector<double> errors = errors_on_loop(known, 11);
  EXPECT_LT(errors[errors.size() / 2], 0.02);
  EXPECT_LT(errors[errors.size() * 95 / 100], 0.04);
  EXPECT_EQ(known.state(), Localization::kTracking);
  EXPECT_EQ(known.times_lost(), 0);
  EXPECT_GT(known.fit(), 0.9);
}

// Walls off the centres of their cells shift the match by as much. Particles use the cell centres,
// and their spread is the prior of the match, which takes back part of the shift.
TEST(MonteCarloLocalizer, WallsAreWhereTheMappingFoundThemInTheirCells) {
  const OccupancyGrid map = map_of_room();
  const Eigen::Vector2d shift(0.012, -0.008);
  std::vector<Eigen::Vector2d> ends;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (is_occupied(map.at(x, y))) ends.push_back(map.centre_of(x, y) + shift);
    }
  }
  HitGrid walls(map.resolution_m);
  walls.add_ends(ends);
  walls.add_ends(ends);
  MonteCarloLocalizer in_the_middle = localizer(1);
  MonteCarloLocalizer beside(map, LocalizerSettings{}, LaserParameters{}.X_RL, 1, &walls);
  in_the_middle.start_at(roughly(loop().start));
  beside.start_at(roughly(loop().start));
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int count = 0;
  sense(room(), loop(), {}, 11,
        [&](const LaserScan& scan, const PlanarPose& odometry, const PlanarPose&) {
          in_the_middle.update(scan, odometry);
          beside.update(scan, odometry);
          sum += position_of(beside.estimate_at(odometry).pose_M) -
                 position_of(in_the_middle.estimate_at(odometry).pose_M);
          ++count;
        });
  const Eigen::Vector2d share = (sum / count).cwiseQuotient(shift);
  EXPECT_GT(share.minCoeff(), 0.4);
  EXPECT_LT(share.maxCoeff(), 1.0);
}

TEST(MonteCarloLocalizer, FindsItselfWithoutAStart) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    MonteCarloLocalizer lost = localizer(seed);
    EXPECT_EQ(lost.state(), Localization::kSearching);
    const std::vector<double> errors = errors_on_loop(lost, 20 + seed);
    EXPECT_EQ(lost.state(), Localization::kTracking) << seed;
    EXPECT_LT(errors[errors.size() * 95 / 100], 0.05) << seed;
  }
}

TEST(MonteCarloLocalizer, NoticesThatItWasCarriedAway) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    MonteCarloLocalizer kidnapped = localizer(seed);
    // Believed to be elsewhere and turned around.
    kidnapped.start_at(roughly({1.0, 1.0, 2.5}));
    const std::vector<double> errors = errors_on_loop(kidnapped, 30 + seed);
    EXPECT_EQ(kidnapped.state(), Localization::kTracking) << seed;
    EXPECT_EQ(kidnapped.times_lost(), 1) << seed;
    EXPECT_LT(errors[errors.size() / 2], 0.02) << seed;
  }
}

TEST(MonteCarloLocalizer, TheSameSeedGivesTheSamePose) {
  std::vector<double> first;
  for (int i = 0; i < 2; ++i) {
    MonteCarloLocalizer again = localizer(4);
    again.start_at(roughly(loop().start));
    const std::vector<double> errors = errors_on_loop(again, 41);
    if (i == 0) first = errors;
    EXPECT_EQ(errors, first);
  }
}

TEST(MonteCarloLocalizer, TwoInTwoThreadsAreAsOneAfterTheOther) {
  const auto errors_of = [](std::uint64_t seed) {
    MonteCarloLocalizer known = localizer(seed);
    known.start_at(roughly(loop().start));
    return errors_on_loop(known, 40 + seed);
  };
  const std::vector<double> first = errors_of(1);
  const std::vector<double> second = errors_of(2);
  std::vector<std::vector<double>> found(2);
  std::thread one([&] { found[0] = errors_of(1); });
  std::thread two([&] { found[1] = errors_of(2); });
  one.join();
  two.join();
  EXPECT_EQ(found[0], first);
  EXPECT_EQ(found[1], second);
  EXPECT_NE(first, second);
}

TEST(MonteCarloLocalizer, TheBeliefGoesOnWithTheWheelsAndGrowsUnsure) {
  MonteCarloLocalizer known = localizer(1);
  known.start_at(roughly({0.0, 0.0, kPi / 2.0}));
  LaserScan first;
  sense(room(), {{0.0, 0.0, kPi / 2.0}, {{{0.0, 0.0}, 0.01}}}, {}, 1,
        [&](const LaserScan& scan, const PlanarPose&, const PlanarPose&) { first = scan; });
  ASSERT_TRUE(known.update(first, {5.0, 5.0, 0.0}));
  const PoseEstimate here = known.estimate_at({5.0, 5.0, 0.0});
  const PoseEstimate ahead = known.estimate_at({5.08, 5.0, 0.0});
  EXPECT_NEAR(ahead.pose_M.y - here.pose_M.y, 0.08, 1e-3);
  EXPECT_GT(ahead.covariance(1, 1), here.covariance(1, 1));
}

TEST(MonteCarloLocalizer, RefusesMapsAndStartsOfNoUse) {
  OccupancyGrid map = map_of_room();
  std::fill(map.cells.begin(), map.cells.end(), std::int8_t{0});
  EXPECT_THROW(MonteCarloLocalizer(map, {}, {}, 1), Error);
  std::fill(map.cells.begin(), map.cells.end(), std::int8_t{100});
  EXPECT_THROW(MonteCarloLocalizer(map, {}, {}, 1), Error);
  EXPECT_THROW(MonteCarloLocalizer(OccupancyGrid{}, {}, {}, 1), Error);
  MonteCarloLocalizer known = localizer(1);
  EXPECT_THROW(known.start_at(roughly({std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0})),
               Error);
}

TEST(MonteCarloLocalizer, PassesOverScansThatSayNothing) {
  MonteCarloLocalizer known = localizer(1);
  known.start_at(roughly({}));
  LaserScan scan;
  scan.angle_step_rad = 0.01;
  scan.min_range_m = 0.1;
  scan.max_range_m = 10.0;
  EXPECT_FALSE(known.update(scan, {}));
  scan.ranges_m.assign(100, 0.0F);
  EXPECT_FALSE(known.update(scan, {}));
  EXPECT_EQ(known.estimate_at({}).pose_M.x, 0.0);
}

}  // namespace
}  // namespace tagfield
