// SPDX-License-Identifier: Apache-2.0
#include "tagfield/poses/trajectory.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <random>

#include "tagfield/base/test/error_text.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

Time at(double seconds) { return time_from_seconds(seconds); }

StampedPose pose(double seconds, double x, double yaw = 0.0) {
  return {at(seconds), from_planar(x, 0.0, yaw)};
}

/// At 0 m until 1 s, then at 1 m/s to 3 m, turning along the way.
Trajectory moving() {
  return {pose(0.0, 0.0), pose(1.0, 0.0), pose(2.0, 1.0), pose(4.0, 3.0, 1.0)};
}

double x_of(const std::optional<RigidTransform>& X) { return X.value().translation.x(); }

TEST(PoseAt, IsThePoseItselfOnItsStamp) {
  for (const StampedPose& each : moving()) {
    EXPECT_EQ(x_of(pose_at(moving(), each.stamp)), each.X_WB.translation.x());
  }
}

TEST(PoseAt, InterpolatesBetween) {
  EXPECT_DOUBLE_EQ(x_of(pose_at(moving(), at(1.25))), 0.25);
  const auto X = pose_at(moving(), at(3.5));
  EXPECT_DOUBLE_EQ(x_of(X), 2.5);
  EXPECT_NEAR(yaw_of(X->rotation), 0.75, 1e-14);
}

TEST(PoseAt, IsNoneOutside) {
  EXPECT_FALSE(pose_at(moving(), at(0.0) - Duration(1)).has_value());
  EXPECT_FALSE(pose_at(moving(), at(4.0) + Duration(1)).has_value());
  EXPECT_FALSE(pose_at({}, at(0.0)).has_value());
}

TEST(PoseAt, OfOnePoseStandsForEver) {
  const Trajectory one = {pose(5.0, 2.0)};
  for (const double seconds : {-1e6, 0.0, 5.0, 1e9})
    EXPECT_EQ(x_of(pose_at(one, at(seconds))), 2.0);
}

TEST(PoseAt, RefusesGapsLongerThanAllowed) {
  const Duration second = std::chrono::seconds(1);
  EXPECT_TRUE(pose_at(moving(), at(1.5), second).has_value());  // A gap of exactly max_gap.
  EXPECT_FALSE(pose_at(moving(), at(3.0), second).has_value());
  EXPECT_FALSE(pose_at(moving(), at(1.5), second - Duration(1)).has_value());
  EXPECT_TRUE(pose_at(moving(), at(3.0), 2 * second).has_value());
  EXPECT_EQ(x_of(pose_at(moving(), at(4.0), Duration(1))), 3.0);  // On a timestamp: no gap.
}

TEST(PoseAt, CrossesLongGapsOfABodyThatStood) {
  const Duration short_gap = std::chrono::milliseconds(1);
  EXPECT_EQ(x_of(pose_at(moving(), at(0.5), short_gap)), 0.0);
  EXPECT_TRUE(pose_at(moving(), at(1.5), short_gap, 1.001).has_value());
  EXPECT_FALSE(pose_at(moving(), at(1.5), short_gap, 0.999).has_value());
}

TEST(HeldPoseAt, HoldsTheEnds) {
  EXPECT_EQ(x_of(held_pose_at(moving(), at(-10.0))), 0.0);
  EXPECT_EQ(x_of(held_pose_at(moving(), at(4.0))), 3.0);
  EXPECT_EQ(x_of(held_pose_at(moving(), at(1e6))), 3.0);
  EXPECT_EQ(x_of(held_pose_at({pose(5.0, 2.0)}, at(1.0))), 2.0);
}

TEST(HeldPoseAt, InterpolatesBetweenTheEnds) {
  EXPECT_DOUBLE_EQ(x_of(held_pose_at(moving(), at(1.75))), 0.75);
  EXPECT_DOUBLE_EQ(x_of(held_pose_at(moving(), at(2.0))), 1.0);
}

RC_GTEST_PROP(HeldPositionAt, IsThePlaceOfTheHeldPose, (std::int64_t seed)) {
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  std::uniform_real_distribution<double> some(-3.0, 3.0);
  Trajectory trajectory;
  for (int i = 0; i < 4; ++i) {
    trajectory.push_back(
        {at(i), RigidTransform{
                    Eigen::Quaterniond(some(random), some(random), some(random), 1.0).normalized(),
                    {some(random), some(random), some(random)}}});
  }
  for (const double stamp_s : {-1.0, 0.0, 1.0, 3.0, 4.0, std::abs(some(random))}) {
    RC_ASSERT(held_position_at(trajectory, at(stamp_s)) ==
              held_pose_at(trajectory, at(stamp_s)).translation);
  }
}

TEST(HeldPoseAt, IsExactWithTodaysStamps) {
  const Time now = parse_stamp("1700000000.000000001");
  const Trajectory trajectory = {{now, from_planar(0.0, 0.0, 0.0)},
                                 {now + Duration(1000), from_planar(1.0, 0.0, 0.0)}};
  EXPECT_DOUBLE_EQ(x_of(held_pose_at(trajectory, now + Duration(1))), 0.001);
}

TEST(RequireRisingStamps, TakesRisingOnesAndNone) {
  EXPECT_NO_THROW(require_rising_stamps(moving()));
  EXPECT_NO_THROW(require_rising_stamps({}));
}

TEST(RequireRisingStamps, NamesTheStampsThatDoNot) {
  EXPECT_EQ(error_of([] {
              require_rising_stamps({pose(2.0, 0.0), pose(1.0, 0.0)});
            }),
            "times must rise: 1.000000000 s follows 2.000000000 s");
  EXPECT_THROW(require_rising_stamps({pose(1.0, 0.0), pose(1.0, 0.0)}), Error);
}

TEST(PathLength, AddsTheLegs) {
  EXPECT_DOUBLE_EQ(path_length(moving()), 3.0);
  EXPECT_EQ(path_length({}), 0.0);
  EXPECT_EQ(path_length({pose(0.0, 7.0)}), 0.0);
}

TEST(PathLength, OfACircleIsItsCircumference) {
  Trajectory circle;
  for (int i = 0; i <= 3600; ++i) {
    const double angle = radians(0.1 * i);
    circle.push_back({at(i), from_translation({2 * std::cos(angle), 2 * std::sin(angle), 1.0})});
  }
  // A regular polygon's perimeter, 2 n r sin(π/n).
  EXPECT_NEAR(path_length(circle), 3600 * 4.0 * std::sin(kPi / 3600), 1e-9);
}

}  // namespace
}  // namespace tagfield
