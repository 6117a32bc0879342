// SPDX-License-Identifier: Apache-2.0
#include "tagfield/motion/path_follower.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr double kStep = 0.01;

struct Drive {
  PlanarPose end;
  double length = 0.0;
  double max_deviation = 0.0;  ///< From the polyline [m].
  double fastest = 0.0;
  double fastest_turn = 0.0;
  bool arrived = false;
};

double distance_to_polyline(const std::vector<Eigen::Vector2d>& path, const Eigen::Vector2d& p) {
  double nearest = 1e9;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Vector2d along = path[i] - path[i - 1];
    const double share = std::clamp((p - path[i - 1]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (path[i - 1] + share * along - p).norm());
  }
  return nearest;
}

Drive drive(const PlanarPose& start, const std::vector<Eigen::Vector2d>& waypoints,
            const DrivingStyle& style) {
  PathFollower follower(start, waypoints, style);
  std::vector<Eigen::Vector2d> path = {{start.x, start.y}};
  path.insert(path.end(), waypoints.begin(), waypoints.end());
  Drive result;
  result.end = start;
  for (int i = 0; i < 100'000 && !follower.finished(); ++i) {
    const BodyVelocity velocity = follower.next(result.end, kStep);
    result.end = advance(result.end, velocity, kStep);
    result.length += velocity.forward * kStep;
    result.fastest = std::max(result.fastest, velocity.forward);
    result.fastest_turn = std::max(result.fastest_turn, std::abs(velocity.turn));
    result.max_deviation =
        std::max(result.max_deviation, distance_to_polyline(path, {result.end.x, result.end.y}));
  }
  result.arrived = follower.finished();
  return result;
}

TEST(PathFollower, ReachesEachEndWithinItsLimits) {
  const DrivingStyle style{0.4, 0.8, 0.5};
  const std::vector<std::vector<Eigen::Vector2d>> paths = {
      {{5.0, 0.0}},
      {{3.0, 0.0}, {3.0, 4.0}, {-1.0, 4.0}},
      {{-4.0, 0.0}},                          // begins by turning around
      {{4.0, 0.0}, {0.0, 0.2}},               // almost back again
      {{4.0, 4.0}, {4.0, 0.0}, {0.0, 4.0}}};  // crosses itself
  for (const auto& path : paths) {
    const Drive result = drive({0.0, 0.0, 0.0}, path, style);
    EXPECT_TRUE(result.arrived);
    EXPECT_LT(std::hypot(result.end.x - path.back().x(), result.end.y - path.back().y()), 0.05);
    EXPECT_LE(result.fastest, style.speed_m_s + 1e-12);
    EXPECT_LE(result.fastest_turn, style.max_turn_rad_s + 1e-9);
    EXPECT_LT(result.max_deviation, 1.2 * style.look_ahead_m);
  }
}

TEST(PathFollower, RoundsCornersByAtMostTheLookAhead) {
  const Drive result = drive({0.0, 0.0, 0.0}, {{4.0, 0.0}, {4.0, 4.0}}, {0.3, 1.0, 0.5});
  // The corner is cut, but by no more than the triangle of the look-ahead.
  EXPECT_LT(result.length, 8.0);
  EXPECT_GT(result.length, 8.0 - 2.0 * 0.5);
}

TEST(PathFollower, StandsWithoutWaypoints) {
  PathFollower follower({1.0, 2.0, 0.5}, {}, {});
  EXPECT_TRUE(follower.finished());
  const BodyVelocity velocity = follower.next({1.0, 2.0, 0.5}, kStep);
  EXPECT_EQ(velocity.forward, 0.0);
  EXPECT_EQ(velocity.turn, 0.0);
}

}  // namespace
}  // namespace tagfield
