// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/pose_jumps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tagfield/base/test/error_text.h"

namespace tagfield {
namespace {

/// A lap of 4 m by 3 m at 0.3 m/s, with corners on the spot, a stop, and `noise_m` of white noise.
Trajectory lap(double rate_hz, double noise_m) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal(0.0, 1.0);
  Trajectory track;
  for (int i = 0; i < static_cast<int>(50.0 * rate_hz); ++i) {
    const double time_s = i / rate_hz;
    const double driven = 0.3 * (time_s < 20.0 ? time_s : std::max(20.0, time_s - 3.0));
    const double x = std::min(driven, 4.0) - std::clamp(driven - 7.0, 0.0, 4.0);
    const double y = std::clamp(driven - 4.0, 0.0, 3.0) - std::clamp(driven - 11.0, 0.0, 3.0);
    track.push_back(
        {time_from_seconds(time_s), from_translation({x + noise_m * normal(generator),
                                                      y + noise_m * normal(generator), 1.0})});
  }
  return track;
}

Trajectory with_jump(Trajectory track, double at_s, const Eigen::Vector3d& by) {
  for (StampedPose& pose : track) {
    if (to_seconds(pose.stamp) > at_s) pose.X_WB.translation += by;
  }
  return track;
}

TEST(PoseJumps, AreFoundInAnyDirection) {
  for (int i = 0; i < 8; ++i) {
    const double angle = 0.25 * kPi * i;
    const Eigen::Vector3d by = 0.05 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0);
    const auto jumps = pose_jumps(with_jump(lap(15.0, 0.0), 30.01, by));
    ASSERT_EQ(jumps.size(), 1U) << i;
    EXPECT_NEAR(jumps[0].size_m, 0.05, 1e-9);
    EXPECT_LT(to_seconds(jumps[0].from), 30.01);
    EXPECT_GT(to_seconds(jumps[0].to), 30.01);
  }
}

TEST(PoseJumps, AreTheSameAmidNoiseOfThePoses) {
  const auto jumps = pose_jumps(with_jump(lap(15.0, 0.005), 30.01, {0.2, 0.0, 0.0}));
  ASSERT_EQ(jumps.size(), 1U);
  EXPECT_NEAR(jumps[0].size_m, 0.2, 0.05);
}

// Corners, a stop, few poses, and noise are none.
TEST(PoseJumps, AreNotWhatARobotDrives) {
  for (const double rate_hz : {0.5, 1.0, 2.0, 5.0, 15.0, 50.0}) {
    for (const double noise_m : {0.0, 0.002, 0.02}) {
      EXPECT_TRUE(pose_jumps(lap(rate_hz, noise_m)).empty()) << rate_hz << " " << noise_m;
    }
  }
  EXPECT_TRUE(pose_jumps({}).empty());
}

// Where poses are given at stops only, every step is one.
TEST(PoseJumps, AreNotStepsFromStopToStop) {
  Trajectory track;
  for (int i = 0; i < 400; ++i) {
    track.push_back({time_from_seconds(0.1 * i), from_translation({0.1 * (i / 8), 0.0, 1.0})});
  }
  EXPECT_TRUE(pose_jumps(track).empty());
}

TEST(PoseJumps, AreReportedOnceForARobot) {
  const Trajectory track =
      with_jump(with_jump(lap(15.0, 0.0), 12.01, {0.1, 0.0, 0.0}), 40.01, {0.0, -0.3, 0.0});
  Diagnostics diagnostics;
  warn_of_pose_jumps({{"left", {track, {}}}, {"right", {track, {}}}}, diagnostics);
  ASSERT_EQ(diagnostics.warnings().size(), 1U);
  EXPECT_TRUE(
      contains(diagnostics.warnings()[0], "'left' jump 2 times, at most by 0.30 m, from 40.0"))
      << diagnostics.warnings()[0];
}

}  // namespace
}  // namespace tagfield
