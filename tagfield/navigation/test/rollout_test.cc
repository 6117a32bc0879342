// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/rollout.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tagfield/navigation/test/test_worlds.h"

namespace tagfield {
namespace {

using testing::room_of;

/// The centre of an empty room of 20 m by 20 m.
struct Open {
  OccupancyGrid map = room_of(20.0, 20.0);
  DistanceWindow window{map, {}, {10.0, 10.0}, 4.0, 1.0};
  LocalSettings settings;
  Surroundings around{&window, 1.0, {}, [](const Eigen::Vector2d&) { return true; }};
  PlanarPose pose{10.0, 10.0, 0.0};

  [[nodiscard]] Rollouts rollouts(const BodyVelocity& present = {}) const {
    return {pose, present, around, settings};
  }
};

TEST(Rollout, TargetsFollowEachOther) {
  const Manoeuvre manoeuvre{{0.3, 0.1}, 1.0, {0.0, 0.5}, 0.5};
  EXPECT_EQ(target_at(manoeuvre, 0.0).forward, 0.3);
  EXPECT_EQ(target_at(manoeuvre, 0.99).turn, 0.1);
  EXPECT_EQ(target_at(manoeuvre, 1.2).turn, 0.5);
  EXPECT_EQ(target_at(manoeuvre, 1.5).turn, 0.0);
  const Manoeuvre rest = rest_of(manoeuvre, 1.1);
  EXPECT_EQ(rest.first_s, 0.0);
  EXPECT_NEAR(rest.second_s, 0.4, 1e-12);
  EXPECT_EQ(rest_of(manoeuvre, 9.0).second_s, 0.0);
}

TEST(Rollout, GoesAsFarAsTheDriveCan) {
  const Open open;
  // Up to 0.3 m/s at 1 m/s² in 0.3 s, held until 1 s, and down again: 0.3 m in all.
  const Manoeuvre ahead{{0.3, 0.0}, 1.0, {}, 0.0};
  EXPECT_NEAR(open.rollouts().outcome(ahead).moved_m, 0.3, 1e-9);
  EXPECT_NEAR(open.rollouts().after(ahead, 1.0).x, 10.0 + 0.255, 1e-9);
  // Braking from 0.8 m/s takes 0.32 m.
  EXPECT_NEAR(open.rollouts({0.8, 0.0}).outcome({}).moved_m, 0.32, 1e-9);
  EXPECT_NEAR(open.rollouts().outcome({{0.0, 1.5}, 1.0, {}, 0.0}).turned_rad, 1.5, 1e-9);
  EXPECT_EQ(open.rollouts().outcome({}).moved_m, 0.0);
}

TEST(Rollout, MeasuresToWhatStands) {
  Open open;
  open.window = DistanceWindow(open.map, {{11.0, 10.0}}, {10.0, 10.0}, 4.0, 1.5);
  const Outcome ahead = open.rollouts().outcome({{0.5, 0.0}, 1.0, {}, 0.0});
  EXPECT_NEAR(ahead.clear_m, 0.5, 0.06);
  EXPECT_NEAR(ahead.end_clear_m, 0.5, 0.06);
  const Outcome past = open.rollouts().outcome({{0.8, 0.0}, 2.0, {}, 0.0});
  EXPECT_LT(past.clear_m, 0.1);
  EXPECT_GT(past.end_clear_m, 0.4);
}

TEST(Rollout, MeasuresToThoseWhoMoveAlsoAtRest) {
  Open open;
  // Passes 1 m ahead after 4 s, when the robot would long be at rest.
  open.around.moving = {{{11.0, 6.0}, {0.0, 1.0}, 0.3}};
  EXPECT_NEAR(open.rollouts().outcome({}).gap_m, 1.0 - 0.36 - 0.3 - 0.25, 1e-6);
  EXPECT_LT(open.rollouts().outcome({{0.3, 0.0}, 2.0, {}, 0.0}).gap_m, 0.0);
  // Already past: only what happens between now and the horizon counts.
  open.around.moving = {{{11.0, 10.0 + 1.5}, {0.0, 1.0}, 0.3}};
  EXPECT_GT(open.rollouts().outcome({}).gap_m, 1.0);
}

TEST(Rollout, KnowsWhereItBacksBlindly) {
  Open open;
  open.around.is_known_free = [](const Eigen::Vector2d& p) { return p.x() > 9.5; };
  EXPECT_FALSE(open.rollouts().outcome({{-0.2, 0.0}, 0.5, {}, 0.0}).backs_blindly);
  EXPECT_TRUE(open.rollouts().outcome({{-0.2, 0.0}, 1.5, {}, 0.0}).backs_blindly);
  EXPECT_FALSE(open.rollouts().outcome({{0.2, 0.0}, 1.5, {}, 0.0}).backs_blindly);
}

RC_GTEST_PROP(RolloutProperties, AgreesWithAFineIntegration, ()) {
  const Open open;
  const auto draw = [](int most) { return *rc::gen::inRange(-most, most + 1) * 0.01; };
  const BodyVelocity present{draw(80), draw(150)};
  const Manoeuvre manoeuvre{{draw(80), draw(150)},
                            *rc::gen::inRange(0, 15) * 0.1,
                            {draw(80), draw(150)},
                            *rc::gen::inRange(0, 15) * 0.1};
  PlanarPose pose = open.pose;
  BodyVelocity velocity = present;
  for (int i = 0; i < 6000; ++i) {
    velocity = limited(target_at(manoeuvre, i * 1e-3), velocity, open.settings.limits, 1e-3);
    pose = advance(pose, velocity, 1e-3);
  }
  const Outcome result = open.rollouts(present).outcome(manoeuvre);
  RC_ASSERT(std::abs(result.moved_m - std::hypot(pose.x - 10.0, pose.y - 10.0)) < 0.06);
  RC_ASSERT(std::abs(result.turned_rad - std::abs(pose.yaw)) < 0.12);
}

}  // namespace
}  // namespace tagfield
