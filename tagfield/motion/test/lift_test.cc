#include "tagfield/motion/lift.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace tagfield
