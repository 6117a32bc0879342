// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/moving_obstacles.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tagfield/navigation/test/test_worlds.h"

namespace tagfield {
namespace {

using testing::BoxWorld;
using testing::walls;

const BoxWorld& watched_hall() {
  static const BoxWorld world(walls({-10.0, -10.0}, {10.0, 10.0}), {0.0, 0.0});
  return world;
}

/// Feeds the tracker scans from a moving robot among moving obstacles.
struct Watch {
  ObstacleTracker tracker;
  std::function<PlanarPose(double)> robot = [](double) { return PlanarPose{}; };
  std::function<Obstacles(double)> obstacles;
  std::int64_t scans = 0;

  void until(double seconds) {
    const LaserParameters laser;
    for (; scans <= std::lround(30.0 * seconds); ++scans) {
      const PlanarPose pose = robot(static_cast<double>(scans) / 30.0);
      const RigidTransform X_WR = to_transform(pose);
      const LaserScan scan = simulate_scan(
          watched_hall().rays, laser, scans, [&](Time) { return X_WR; },
          [&](Time now) { return obstacles(to_seconds(now)); }, 3, 4);
      const ScanInMap seen = scan_in_map(scan, laser.X_RL, pose, {});
      std::vector<bool> is_candidate;
      for (const ScanReturn& hit : seen.returns) {
        is_candidate.push_back(hit.point_M.cwiseAbs().maxCoeff() < 9.7);
      }
      tracker.update(seen, is_candidate);
    }
  }
  [[nodiscard]] std::vector<MovingObstacle> moving() const {
    return tracker.moving(time_from_seconds(static_cast<double>(scans - 1) / 30.0));
  }
};

std::function<Obstacles(double)> disc(const Eigen::Vector2d& start, const Eigen::Vector2d& velocity,
                                      double radius = 0.3) {
  return [=](double t) { return Obstacles{{{start + t * velocity, radius}}, {}}; };
}

TEST(ObstacleTracker, FollowsWhoWalks) {
  for (const Eigen::Vector2d& velocity :
       {Eigen::Vector2d(0.0, 0.5), Eigen::Vector2d(-1.0, 0.0), Eigen::Vector2d(-0.9, -1.2)}) {
    for (const double radius : {0.25, 0.35}) {
      Watch watch;
      watch.obstacles = disc({5.0, 1.0}, velocity, radius);
      watch.until(1.5);
      ASSERT_EQ(watch.moving().size(), 1U);
      const MovingObstacle found = watch.moving().front();
      EXPECT_LT((found.velocity_M - velocity).norm(), 0.15);
      EXPECT_LT((found.centre_M - Eigen::Vector2d(5.0, 1.0) - 1.5 * velocity).norm(), 0.1);
      EXPECT_NEAR(found.radius_m, radius, 0.07);
    }
  }
}

TEST(ObstacleTracker, FollowsFromARobotThatDrivesAndTurns) {
  Watch watch;
  watch.robot = [](double t) { return advance({}, {0.3, 0.4}, t); };
  watch.obstacles = disc({4.0, 2.5}, {0.0, -1.0});
  watch.until(2.0);
  ASSERT_EQ(watch.moving().size(), 1U);
  EXPECT_LT((watch.moving()[0].velocity_M - Eigen::Vector2d(0.0, -1.0)).norm(), 0.15);
}

/// Abeam, with half of the person always beyond the edge of the field of view.
TEST(ObstacleTracker, FollowsWhoIsHalfInView) {
  for (const double radius : {0.2, 0.25, 0.3}) {
    for (const double side : {-1.0, 1.0}) {
      Watch watch;
      watch.obstacles = disc({0.2, 3.0 * side}, {0.0, -0.8 * side}, radius);
      watch.until(2.5);
      ASSERT_EQ(watch.moving().size(), 1U);
      const MovingObstacle found = watch.moving()[0];
      EXPECT_LT((found.velocity_M - Eigen::Vector2d(0.0, -0.8 * side)).norm(), 0.2);
      EXPECT_LT((found.centre_M - Eigen::Vector2d(0.2, side)).norm(), 0.12);
    }
  }
}

/// A flat side gradually revealed at the edge of the field of view or from behind a corner.
TEST(ObstacleTracker, AFlatSideThatComesIntoViewDoesNotMove) {
  for (const double size : {0.4, 0.7}) {
    Watch watch;
    watch.robot = [](double t) { return PlanarPose{-0.6 + 0.3 * t, 0.0, 0.0}; };
    watch.obstacles = [size](double) {
      return Obstacles{{},
                       {{{-0.2, 1.5}, {size, 0.5}, 0.0},
                        {{2.0, 0.6}, {0.3, 0.3}, 0.0},
                        {{3.0, 1.4}, {size, 0.4}, 0.2}}};
    };
    for (double t = 0.2; t < 4.0; t += 0.2) {
      watch.until(t);
      EXPECT_TRUE(watch.moving().empty()) << size << " at " << t;
    }
  }
}

TEST(ObstacleTracker, BoxesThatStandDoNotMove) {
  // Passed at 0.3 m/s, as near as 1 m.
  Watch watch;
  watch.robot = [](double t) { return PlanarPose{-2.0 + 0.3 * t, 0.0, 0.2 * std::sin(t)}; };
  watch.obstacles = [](double) {
    return Obstacles{{{{2.0, -1.5}, 0.3}},
                     {{{1.5, 1.3}, {0.6, 0.4}, 0.4}, {{3.0, 2.0}, {0.3, 0.3}, 0.0}}};
  };
  for (int i = 1; i <= 40; ++i) {
    watch.until(0.25 * i);
    EXPECT_TRUE(watch.moving().empty()) << 0.25 * i;
  }
}

TEST(ObstacleTracker, RemembersWhoIsOutOfSightForAWhile) {
  Watch watch;
  watch.robot = [](double t) { return PlanarPose{0.0, 0.0, t < 2.0 ? 0.0 : kPi}; };
  watch.obstacles = disc({4.0, 3.0}, {0.0, -0.5});
  watch.until(5.0);
  ASSERT_EQ(watch.moving().size(), 1U);
  EXPECT_LT((watch.moving()[0].centre_M - Eigen::Vector2d(4.0, 0.5)).norm(), 0.5);
  watch.until(2.0 + ObstacleTracker::kKeptUnseen + 0.2);
  EXPECT_TRUE(watch.moving().empty());
}

TEST(ObstacleTracker, ForgetsWhoIsGone) {
  Watch watch;
  watch.obstacles = [](double t) {
    return t < 2.0 ? Obstacles{{{{4.0, -1.0 + t}, 0.3}}, {}} : Obstacles{};
  };
  watch.until(1.9);
  EXPECT_EQ(watch.moving().size(), 1U);
  watch.until(2.5);
  EXPECT_TRUE(watch.moving().empty());
}

TEST(ObstacleTracker, KnowsWhoStopped) {
  Watch watch;
  watch.obstacles = [](double t) { return Obstacles{{{{4.0, -1.0 + std::min(t, 2.0)}, 0.3}}, {}}; };
  watch.until(2.0);
  EXPECT_EQ(watch.moving().size(), 1U);
  watch.until(4.0);
  EXPECT_TRUE(watch.moving().empty());
}

TEST(ObstacleTracker, KeepsTwoApart) {
  Watch watch;
  watch.obstacles = [](double t) {
    return Obstacles{{{{4.0, -2.0 + t}, 0.3}, {{5.0, 2.0 - t}, 0.3}}, {}};
  };
  watch.until(1.2);
  ASSERT_EQ(watch.moving().size(), 2U);
  // They pass each other, the farther behind the nearer.
  watch.until(3.5);
  ASSERT_EQ(watch.moving().size(), 2U);
  for (const MovingObstacle& found : watch.moving()) {
    const bool is_near = found.centre_M.x() < 4.5;
    EXPECT_LT((found.velocity_M - Eigen::Vector2d(0.0, is_near ? 1.0 : -1.0)).norm(), 0.3);
  }
}

TEST(ObstacleTracker, ClearForgetsAll) {
  Watch watch;
  watch.obstacles = disc({4.0, -1.0}, {0.0, 1.0});
  watch.until(1.0);
  watch.tracker.clear();
  EXPECT_TRUE(watch.moving().empty());
}

RC_GTEST_PROP(ReturnGroupsProperties, ADiscIsFoundWhereItIs, ()) {
  const double radius = *rc::gen::inRange(20, 50) * 0.01;
  const double distance = *rc::gen::inRange(100, 600) * 0.01;
  const double bearing = *rc::gen::inRange(-120, 121) * 0.01;
  const Eigen::Vector2d centre =
      Eigen::Vector2d(0.15, 0.0) +
      (radius + distance) * Eigen::Vector2d(std::cos(bearing), std::sin(bearing));
  LaserParameters laser;
  laser.sigma_m = 0.0;
  const LaserScan scan = simulate_scan(
      watched_hall().rays, laser, 0, [](Time) { return RigidTransform{}; },
      [&](Time) {
        return Obstacles{{{centre, radius}}, {}};
      },
      1, 1);
  const ScanInMap seen = scan_in_map(scan, laser.X_RL, {}, {});
  std::vector<bool> is_candidate;
  for (const ScanReturn& hit : seen.returns) {
    is_candidate.push_back((hit.point_M - centre).norm() < radius + 0.1);
  }
  const std::vector<ReturnGroup> groups = groups_of(seen, is_candidate);
  RC_ASSERT(groups.size() == 1U);
  RC_ASSERT(!groups[0].is_cut);
  RC_ASSERT(std::abs(groups[0].radius_m - radius) < 0.07);
  RC_ASSERT((groups[0].centre_M - centre).norm() < 0.08);
}

}  // namespace
}  // namespace tagfield
