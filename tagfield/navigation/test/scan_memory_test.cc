// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/scan_memory.h"

#include <gtest/gtest.h>

namespace tagfield {
namespace {

/// Seven beams ahead, 1° apart, from the origin at time `seconds` [s].
ScanInMap scan_at(double seconds, double range_m, double yaw = 0.0) {
  LaserScan scan;
  scan.stamp = time_from_seconds(seconds);
  scan.first_angle_rad = -3.0 * 0.0175;
  scan.angle_step_rad = 0.0175;
  scan.min_range_m = 0.3;
  scan.max_range_m = 10.0;
  scan.ranges_m.assign(7, static_cast<float>(range_m));
  return scan_in_map(scan, {}, {0.0, 0.0, yaw}, {});
}

void see(ScanMemory& memory, const ScanInMap& scan, bool is_on_map, bool left_out = false) {
  const std::size_t count = scan.returns.size();
  memory.see(scan, std::vector<bool>(count, is_on_map), std::vector<bool>(count, left_out));
}

std::size_t count(const ScanMemory& memory) { return memory.around({0.0, 0.0}, 9.0).size(); }

TEST(ScanMemory, KeepsWhatStandsOutOfSight) {
  ScanMemory memory;
  for (int i = 0; i <= 30; ++i) see(memory, scan_at(0.1 * i, 3.0), false);
  EXPECT_GE(count(memory), 6U);
  EXPECT_EQ(memory.not_on_map().size(), count(memory));
  // Seen for 3 s, so kept for 9 s. Meanwhile the robot looks elsewhere, where there is nothing.
  for (int i = 31; i <= 115; ++i) see(memory, scan_at(0.1 * i, 20.0, 2.0), false);
  EXPECT_GE(count(memory), 6U);
  for (int i = 116; i <= 130; ++i) see(memory, scan_at(0.1 * i, 20.0, 2.0), false);
  EXPECT_EQ(count(memory), 0U);
}

TEST(ScanMemory, ForgetsWhatIsSeenThrough) {
  ScanMemory memory;
  for (int i = 0; i <= 10; ++i) see(memory, scan_at(0.1 * i, 3.0), false);
  for (int i = 11; i <= 14; ++i) see(memory, scan_at(0.1 * i, 5.0), false);
  for (const Eigen::Vector2d& point : memory.around({0.0, 0.0}, 9.0)) {
    EXPECT_NEAR(point.norm(), 5.0, 0.01);
  }
  EXPECT_GE(count(memory), 6U);
}

TEST(ScanMemory, WhatStandsBehindSomethingNearerIsNotSeenThrough) {
  ScanMemory memory;
  for (int i = 0; i <= 10; ++i) see(memory, scan_at(0.1 * i, 3.0), false);
  for (int i = 11; i <= 14; ++i) see(memory, scan_at(0.1 * i, 1.0), false);
  EXPECT_GT(count(memory), 9U);
}

TEST(ScanMemory, WhatIsOnTheMapIsForgottenSoon) {
  ScanMemory memory;
  for (int i = 0; i <= 30; ++i) see(memory, scan_at(0.1 * i, 3.0), true);
  EXPECT_TRUE(memory.not_on_map().empty());
  for (int i = 31; i <= 49; ++i) see(memory, scan_at(0.1 * i, 20.0, 2.0), false);
  EXPECT_GT(count(memory), 0U);
  for (int i = 50; i <= 56; ++i) see(memory, scan_at(0.1 * i, 20.0, 2.0), false);
  EXPECT_EQ(count(memory), 0U);
}

TEST(ScanMemory, DoesNotTakeWhatIsLeftOutOrFar) {
  ScanMemory memory;
  see(memory, scan_at(0.0, 3.0), false, true);
  see(memory, scan_at(0.1, 7.0), false);
  EXPECT_EQ(count(memory), 0U);
}

TEST(ScanMemory, StandsOnlyWhatWasSeenForAWhile) {
  ScanMemory memory;
  for (int i = 0; i <= 4; ++i) see(memory, scan_at(0.1 * i, 3.0), false);
  EXPECT_TRUE(memory.not_on_map().empty());
  for (int i = 5; i <= 6; ++i) see(memory, scan_at(0.1 * i, 3.0), false);
  EXPECT_FALSE(memory.not_on_map().empty());
}

TEST(ScanMemory, ForgetsOnRequest) {
  ScanMemory memory;
  see(memory, scan_at(0.0, 3.0), false);
  memory.forget_around({3.0, 0.0}, 0.08);
  EXPECT_GE(count(memory), 3U);
  EXPECT_LE(count(memory), 5U);
  EXPECT_TRUE(memory.around({-5.0, 0.0}, 2.0).empty());
  memory.clear();
  EXPECT_EQ(count(memory), 0U);
}

}  // namespace
}  // namespace tagfield
