// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/path_pursuit.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

using Points = std::vector<Eigen::Vector2d>;

/// Drives at 20 Hz by the commands alone. The final pose, and the greatest distance from the path.
struct Drive {
  PlanarPose end;
  double max_off_m = 0.0;
  double fastest = 0.0;
};

Drive drive(const Points& points, const PlanarPose& start, const PursuitStyle& style) {
  PathPursuit pursuit(Polyline(points), style);
  Drive result{start, 0.0, 0.0};
  BodyVelocity velocity;
  for (int i = 0; i < 4000; ++i) {
    pursuit.follow(result.end);
    const BodyVelocity wanted = pursuit.wanted(result.end);
    velocity = limited(wanted, velocity, style.limits, 0.05);
    result.end = advance(result.end, velocity, 0.05);
    result.fastest = std::max(result.fastest, velocity.forward);
    result.max_off_m = std::max(result.max_off_m, pursuit.distance_m());
    if ((position_of(result.end) - points.back()).norm() < 0.02) break;
  }
  return result;
}

TEST(PathPursuit, ReachesTheEndAndStaysNear) {
  const PursuitStyle style;
  for (const Points& points :
       {Points{{0.0, 0.0}, {5.0, 0.0}}, Points{{0.0, 0.0}, {3.0, 0.0}, {3.0, 3.0}},
        Points{{0.0, 0.0}, {-2.0, 0.5}}, Points{{0.0, 0.0}, {2.0, 0.0}, {0.0, 0.5}}}) {
    const Drive result = drive(points, {}, style);
    EXPECT_LT((position_of(result.end) - points.back()).norm(), 0.02);
    EXPECT_LT(result.max_off_m, 0.25);
    EXPECT_NEAR(result.fastest, 0.3, 0.01);
  }
}

TEST(PathPursuit, TurnsOnTheSpotWhereTheWayLiesBehind) {
  PathPursuit pursuit(Polyline(Points{{0.0, 0.0}, {-3.0, 0.1}}), {});
  const BodyVelocity wanted = pursuit.wanted({});
  EXPECT_EQ(wanted.forward, 0.0);
  EXPECT_GT(wanted.turn, 0.5);
  EXPECT_GT(pursuit.to_turn_rad({}), 3.0);
  // Once begun, it turns until it faces along the path.
  EXPECT_EQ(pursuit.wanted({0.0, 0.0, kPi - 0.3}).forward, 0.0);
  EXPECT_GT(pursuit.wanted({0.0, 0.0, kPi - 0.1}).forward, 0.0);
  EXPECT_EQ(pursuit.to_turn_rad({0.0, 0.0, kPi - 0.3}), 0.0);
}

TEST(PathPursuit, SlowsDownTowardsTheEnd) {
  PathPursuit pursuit(Polyline(Points{{0.0, 0.0}, {3.0, 0.0}}), {});
  for (int i = 0; i < 60; ++i) pursuit.follow({0.05 * i, 0.0, 0.0});
  EXPECT_NEAR(pursuit.remaining_m(), 0.05, 1e-12);
  EXPECT_LT(pursuit.wanted({2.95, 0.0, 0.0}).forward, 0.1);
  EXPECT_GT(pursuit.wanted({2.95, 0.0, 0.0}).forward, 0.01);
}

TEST(PathPursuit, KeepsToTheDrivesSpeed) {
  PursuitStyle style;
  style.limits.speed_m_s = 0.2;
  PathPursuit pursuit(Polyline(Points{{0.0, 0.0}, {3.0, 0.0}}), style);
  EXPECT_EQ(pursuit.wanted({}).forward, 0.2);
}

TEST(PathPursuit, AWayOfOnePointIsNowhereToGo) {
  PathPursuit pursuit(Polyline(Points{{1.0, 1.0}}), {});
  pursuit.follow({1.0, 1.0, 0.5});
  EXPECT_EQ(pursuit.remaining_m(), 0.0);
  EXPECT_LT(pursuit.wanted({1.0, 1.0, 0.5}).forward, 0.05);
}

RC_GTEST_PROP(TurnRateProperties, CanStopInTime, ()) {
  const SpeedLimits limits{0.8, *rc::gen::inRange(3, 30) * 0.1, 1.0,
                           *rc::gen::inRange(3, 60) * 0.1};
  const double angle = *rc::gen::inRange(-3140, 3141) * 0.001;
  const double rate = turn_rate(angle, limits);
  RC_ASSERT(std::abs(rate) <= limits.turn_rad_s);
  RC_ASSERT(rate * angle >= 0.0);
  RC_ASSERT(rate * rate / (2.0 * limits.turn_acceleration_rad_s2) <= std::abs(angle) + 1e-12);
}

}  // namespace
}  // namespace tagfield
