// SPDX-License-Identifier: Apache-2.0
#include "tagfield/motion/lift.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tagfield {
namespace {

TEST(LiftHeight, GoesUpAndDownAtItsSpeed) {
  const Lift lift{1.5, 0.5};  // 3 s up, 3 s down
  EXPECT_NEAR(lift_height(lift, time_from_seconds(0.0)), 0.0, 1e-12);
  EXPECT_NEAR(lift_height(lift, time_from_seconds(1.0)), 0.5, 1e-12);
  EXPECT_NEAR(lift_height(lift, time_from_seconds(3.0)), 1.5, 1e-12);
  EXPECT_NEAR(lift_height(lift, time_from_seconds(4.0)), 1.0, 1e-12);
  EXPECT_NEAR(lift_height(lift, time_from_seconds(6.0)), 0.0, 1e-12);
  EXPECT_NEAR(lift_height(lift, time_from_seconds(601.0)), 0.5, 1e-9);
}

TEST(LiftHeight, IsZeroWithoutTravel) {
  EXPECT_EQ(lift_height({0.0, 0.35}, time_from_seconds(12.0)), 0.0);
}

TEST(LiftGuide, GoesUpAndDownUntilGivenAHeight) {
  const Lift lift{1.0, 0.25};
  LiftGuide guide(lift);
  EXPECT_NEAR(guide.height(time_from_seconds(2.0)), 0.5, 1e-12);
  ASSERT_TRUE(guide.go_to(0.2));
  EXPECT_NEAR(guide.height(time_from_seconds(3.0)), 0.25, 1e-12);
  EXPECT_NEAR(guide.height(time_from_seconds(4.0)), 0.2, 1e-12);
  EXPECT_NEAR(guide.height(time_from_seconds(400.0)), 0.2, 1e-12);
}

TEST(LiftGuide, StopsAtItsEnds) {
  LiftGuide guide(Lift{1.0, 0.25});
  ASSERT_TRUE(guide.go_to(7.0));
  EXPECT_NEAR(guide.height(time_from_seconds(2.0)), 0.5, 1e-12);
  EXPECT_NEAR(guide.height(time_from_seconds(60.0)), 1.0, 1e-12);
  ASSERT_TRUE(guide.go_to(-1.0));
  EXPECT_NEAR(guide.height(time_from_seconds(120.0)), 0.0, 1e-12);
}

TEST(LiftGuide, RefusesWhatIsNotFinite) {
  LiftGuide guide(Lift{1.0, 0.25});
  EXPECT_FALSE(guide.go_to(std::nan("")));
  EXPECT_FALSE(guide.go_to(HUGE_VAL));
  EXPECT_NEAR(guide.height(time_from_seconds(2.0)), 0.5, 1e-12);
}

}  // namespace
}  // namespace tagfield
