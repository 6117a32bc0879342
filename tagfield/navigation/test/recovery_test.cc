// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/recovery.h"

#include <gtest/gtest.h>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

Time after(double seconds) { return time_from_seconds(seconds); }

TEST(Recovery, LooksAroundAndBacksUpByTurns) {
  const SpeedLimits limits;
  Recovery recovery;
  EXPECT_FALSE(recovery.is_on());
  EXPECT_FALSE(recovery.wanted({}, after(0.0), limits));
  recovery.begin({}, after(0.0));
  EXPECT_TRUE(recovery.is_on());
  // Half a turn at 0.75 rad/s, across the wrap of the yaw.
  double yaw = 3.0;
  recovery.begin({}, after(0.0));  // Backing up is the second try.
  const auto back = recovery.wanted({}, after(1.0), limits);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->forward, -0.15);
  EXPECT_EQ(back->turn, 0.0);
  EXPECT_FALSE(recovery.wanted({}, after(2.1), limits));
  EXPECT_FALSE(recovery.is_on());
  recovery.begin({0.0, 0.0, yaw}, after(3.0));
  double t = 3.0;
  for (; recovery.wanted({0.0, 0.0, wrap_to_pi(yaw)}, after(t), limits); t += 0.05) {
    EXPECT_EQ(recovery.wanted({0.0, 0.0, wrap_to_pi(yaw)}, after(t), limits)->forward, 0.0);
    yaw += 0.05 * 0.75;
  }
  EXPECT_NEAR(yaw - 3.0, radians(170.0), 0.05);
}

TEST(Recovery, DoesNotTurnForEver) {
  Recovery recovery;
  recovery.begin({}, after(0.0));
  EXPECT_TRUE(recovery.wanted({}, after(5.9), {}));
  EXPECT_FALSE(recovery.wanted({}, after(6.1), {}));
}

TEST(Recovery, ResetEndsIt) {
  Recovery recovery;
  recovery.begin({}, after(0.0));
  recovery.reset();
  EXPECT_FALSE(recovery.is_on());
  recovery.begin({}, after(0.0));
  EXPECT_GT(recovery.wanted({}, after(0.1), {})->turn, 0.0);
}

}  // namespace
}  // namespace tagfield
