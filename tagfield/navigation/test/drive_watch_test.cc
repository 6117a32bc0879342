// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/drive_watch.h"

#include <gtest/gtest.h>

namespace tagfield {
namespace {

Time at(double seconds) { return time_from_seconds(seconds); }

TEST(DriveWatch, WaitsSinceItGotNearer) {
  DriveWatch watch;
  watch.begin(10.0, at(0.0));
  watch.update(9.0, at(5.0));
  EXPECT_EQ(watch.waited_s(at(7.0)), 2.0);
  watch.update(8.97, at(6.0));  // Too little to count.
  watch.update(9.5, at(6.5));   // Farther again.
  EXPECT_EQ(watch.waited_s(at(7.0)), 2.0);
  watch.update(8.9, at(8.0));
  EXPECT_EQ(watch.waited_s(at(8.0)), 0.0);
}

TEST(DriveWatch, IsStuckSinceTheLastTry) {
  DriveWatch watch;
  watch.begin(10.0, at(0.0));
  watch.tried(at(5.0));
  EXPECT_EQ(watch.waited_s(at(7.0)), 7.0);
  EXPECT_EQ(watch.stuck_s(at(7.0)), 2.0);
  watch.update(9.0, at(8.0));
  EXPECT_EQ(watch.stuck_s(at(9.0)), 1.0);
}

TEST(DriveWatch, DetoursRenewPatienceAFewTimesOnly) {
  DriveWatch watch;
  watch.begin(10.0, at(0.0));
  double now = 0.0;
  for (int i = 0; i < DriveWatch::kMaxDetours; ++i) {
    now += 10.0;
    watch.detour(12.0 + i, at(now));
    EXPECT_EQ(watch.waited_s(at(now)), 0.0);
  }
  watch.detour(30.0, at(now + 10.0));
  EXPECT_EQ(watch.waited_s(at(now + 10.0)), 10.0);
  // Sufficient progress restores the detours.
  watch.update(20.0, at(now + 11.0));
  watch.detour(25.0, at(now + 20.0));
  EXPECT_EQ(watch.waited_s(at(now + 20.0)), 0.0);
}

TEST(DriveWatch, AShorterWayIsNoDetour) {
  DriveWatch watch;
  watch.begin(10.0, at(0.0));
  watch.detour(8.0, at(5.0));
  EXPECT_EQ(watch.waited_s(at(5.0)), 5.0);
  watch.update(9.0, at(6.0));
  EXPECT_EQ(watch.waited_s(at(6.0)), 6.0);
}

}  // namespace
}  // namespace tagfield
