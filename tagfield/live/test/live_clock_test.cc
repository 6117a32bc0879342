// SPDX-License-Identifier: Apache-2.0
#include "tagfield/live/internal/live_clock.h"

#include <gtest/gtest.h>

#include <vector>

namespace tagfield {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

LiveClock::Wall wall(std::chrono::nanoseconds since) { return LiveClock::Wall(since); }
Time at(double seconds) { return time_from_seconds(seconds); }

TEST(LiveClock, StepsAreDueAtItsSpeed) {
  LiveClock clock(1.0, false);
  clock.set_speed(1.0, at(0.0), wall(seconds(100)));
  EXPECT_EQ(clock.due(at(2.0)), wall(seconds(102)));
  clock.set_speed(10.0, at(2.0), wall(seconds(102)));
  EXPECT_EQ(clock.due(at(12.0)), wall(seconds(103)));
  clock.set_speed(0.0, at(12.0), wall(seconds(103)));
  EXPECT_LE(clock.due(at(1e6)), wall(seconds(103)));
}

TEST(LiveClock, WhatAPauseTookIsNotMadeUpFor) {
  LiveClock clock(1.0, false);
  clock.set_speed(1.0, at(0.0), wall(seconds(0)));
  clock.pause();
  EXPECT_TRUE(clock.is_paused(at(5.0)));
  clock.resume(at(5.0), wall(seconds(50)));
  EXPECT_FALSE(clock.is_paused(at(5.0)));
  EXPECT_EQ(clock.due(at(6.0)), wall(seconds(51)));
}

TEST(LiveClock, RunsUntilAndIsPausedThen) {
  LiveClock clock(2.0, true);
  EXPECT_TRUE(clock.is_paused(at(0.0)));
  clock.run_until(at(0.5), at(0.0), wall(seconds(10)));
  EXPECT_FALSE(clock.is_paused(at(0.49)));
  EXPECT_TRUE(clock.is_paused(at(0.5)));
  EXPECT_EQ(clock.due(at(0.5)), wall(seconds(10) + milliseconds(250)));
}

TEST(LiveClock, RunsAddUpToWhatWasAsked) {
  LiveClock clock(0.0, true);
  double now = 0.0;
  const auto run_for = [&](double length) {
    clock.run_for(duration_from_seconds(length), at(now), wall(seconds(0)));
    while (!clock.is_paused(at(now))) now += 0.25;  // The simulation's steps.
  };
  std::vector<double> ends;
  for (int i = 0; i < 6; ++i) {
    run_for(0.125);
    ends.push_back(now);
  }
  EXPECT_EQ(ends, (std::vector<double>{0.25, 0.25, 0.5, 0.5, 0.75, 0.75}));
  run_for(0.0625);
  EXPECT_EQ(now, 1.0);
  clock.pause();
  run_for(0.125);
  EXPECT_EQ(now, 1.25);
}

TEST(LiveClock, TellsWhenAStepEnds) {
  LiveClock clock(1.0, true);
  EXPECT_EQ(clock.step_end(at(0.0)), std::nullopt);
  clock.run_until(at(0.5), at(0.0), wall(seconds(10)));
  EXPECT_EQ(clock.step_end(at(0.4)), at(0.5));
  EXPECT_EQ(clock.step_end(at(0.5)), std::nullopt);
  clock.resume(at(0.5), wall(seconds(11)));
  EXPECT_EQ(clock.step_end(at(9.0)), std::nullopt);
}

TEST(LiveClock, WhatItFellBehindIsNotMadeUpFor) {
  LiveClock clock(1.0, false);
  clock.set_speed(1.0, at(0.0), wall(seconds(0)));
  clock.stepped(at(0.1), wall(milliseconds(400)));  // a small lag: it catches up
  EXPECT_EQ(clock.due(at(0.2)), wall(milliseconds(200)));
  clock.stepped(at(0.2), wall(seconds(9)));
  EXPECT_EQ(clock.due(at(0.3)), wall(seconds(9) + milliseconds(100)));
}

TEST(LiveClock, TellsItsPace) {
  LiveClock clock(0.0, false);
  clock.set_speed(0.0, at(0.0), wall(seconds(0)));
  clock.resume(at(0.0), wall(seconds(0)));
  for (int i = 1; i <= 30; ++i) clock.stepped(at(0.7 * i), wall(milliseconds(100) * i));
  EXPECT_NEAR(clock.pace(at(21.0), wall(seconds(3))), 7.0, 1e-9);
  clock.pause();
  EXPECT_EQ(clock.pace(at(21.0), wall(seconds(3))), 0.0);
}

}  // namespace
}  // namespace tagfield
