// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/body_motion.h"

#include <gtest/gtest.h>

namespace tagfield {
namespace {

MovingBody body_at(const std::string& name, double x) {
  MovingBody body;
  body.name = name;
  body.p_W = {x, 0.0, 0.0};
  return body;
}

TEST(BodyMotion, BodiesAreMatchedByName) {
  BodyMotion motion;
  EXPECT_TRUE(motion.empty());
  motion.see({body_at("a", 0.0), body_at("b", 10.0)}, time_from_seconds(1.0));
  motion.see({body_at("b", 12.0), body_at("a", 1.0), body_at("c", 5.0)}, time_from_seconds(2.0));
  const std::vector<MovingBody> then = motion.at(time_from_seconds(1.25));
  ASSERT_EQ(then.size(), 3U);
  EXPECT_NEAR(then[0].p_W.x(), 10.5, 1e-12);
  EXPECT_NEAR(then[1].p_W.x(), 0.25, 1e-12);
  EXPECT_EQ(then[2].p_W.x(), 5.0);
  // No extrapolation.
  EXPECT_EQ(motion.at(time_from_seconds(3.0))[0].p_W.x(), 12.0);
}

/// A driver may tell several antennas of the same time in turn.
TEST(BodyMotion, TheSameTimeAgainReplacesOnlyTheLastPoses) {
  BodyMotion motion;
  motion.see({body_at("a", 0.0)}, time_from_seconds(1.0));
  motion.see({body_at("a", 1.0)}, time_from_seconds(2.0));
  motion.see({body_at("a", 2.0)}, time_from_seconds(2.0));
  EXPECT_NEAR(motion.at(time_from_seconds(1.5))[0].p_W.x(), 1.0, 1e-12);
}

}  // namespace
}  // namespace tagfield
