// SPDX-License-Identifier: Apache-2.0
#include "tagfield/laser/laser_scan.h"

#include <gtest/gtest.h>

namespace tagfield {
namespace {

TEST(LaserScan, BeamsSayWhatTheirRangesMean) {
  LaserScan scan;
  scan.min_range_m = 0.3;
  scan.max_range_m = 30.0;
  EXPECT_EQ(beam_of(scan, 0.3F), Beam::kReturn);
  EXPECT_EQ(beam_of(scan, 30.0F), Beam::kReturn);
  EXPECT_EQ(beam_of(scan, 30.001F), Beam::kNothing);
  EXPECT_EQ(beam_of(scan, 0.299F), Beam::kInvalid);
  EXPECT_EQ(beam_of(scan, 0.0F), Beam::kInvalid);
  EXPECT_EQ(beam_of(scan, -1.0F), Beam::kInvalid);
}

TEST(LaserScan, ZeroIsInvalidEvenWhereTheLeastRangeIsZero) {
  LaserScan scan;
  scan.max_range_m = 30.0;
  EXPECT_EQ(beam_of(scan, 0.0F), Beam::kInvalid);
  EXPECT_EQ(beam_of(scan, 1e-3F), Beam::kReturn);
}

TEST(LaserScan, TheRangeThatStandsForNothingSaysSo) {
  for (const double max_m : {0.1, 1.0, 5.6, 30.0, 1000.0, 1e6}) {
    LaserScan scan;
    scan.max_range_m = max_m;
    EXPECT_EQ(beam_of(scan, nothing_range(max_m)), Beam::kNothing) << max_m;
  }
}

TEST(LaserScan, AnglesGrowByTheStep) {
  LaserScan scan;
  scan.first_angle_rad = -1.5;
  scan.angle_step_rad = 0.25;
  EXPECT_EQ(beam_angle(scan, 0), -1.5);
  EXPECT_EQ(beam_angle(scan, 8), 0.5);
}

}  // namespace
}  // namespace tagfield
