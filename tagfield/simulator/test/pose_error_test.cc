// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/pose_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace tagfield {
namespace {

constexpr double kRow = 0.1;

std::vector<PoseError> sample_path(const PoseBelief& belief, std::uint64_t seed, int steps) {
  std::vector<PoseError> path = {first_pose_error(belief, seed, 7)};
  for (int i = 0; i < steps; ++i) {
    path.push_back(
        next_pose_error(belief, path.back(), kRow, seed, 7, static_cast<std::uint64_t>(i)));
  }
  return path;
}

/// Mean over 4000 paths of the product of two errors, `lag` steps apart, from step `from` on.
double covariance(const PoseBelief& belief, std::size_t from, std::size_t lag,
                  double PoseError::*component) {
  constexpr int kPaths = 4000;
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < kPaths; ++seed) {
    const auto path = sample_path(belief, seed, static_cast<int>(from + lag));
    sum += path[from].*component * path[from + lag].*component;
  }
  return sum / kPaths;
}

// The estimate of a variance from 4000 draws has a relative standard error of √(2/4000) = 2.2 %;
// 10 % is more than four of them (false alarm below 1e-5 for each check).
TEST(PoseError, IsStationaryFromTheStart) {
  PoseBelief belief;
  belief.sigma_m = 0.02;
  belief.yaw_sigma_rad = 0.01;
  belief.time_constant_s = 2.0;
  for (const std::size_t step : {0U, 5U, 60U}) {
    EXPECT_NEAR(covariance(belief, step, 0, &PoseError::x) / 4e-4, 1.0, 0.1) << step;
    EXPECT_NEAR(covariance(belief, step, 0, &PoseError::y) / 4e-4, 1.0, 0.1) << step;
    EXPECT_NEAR(covariance(belief, step, 0, &PoseError::yaw) / 1e-4, 1.0, 0.1) << step;
  }
}

TEST(PoseError, ForgetsWithItsTimeConstant) {
  PoseBelief belief;
  belief.sigma_m = 1.0;
  belief.time_constant_s = 2.0;
  for (const std::size_t lag : {5U, 20U, 40U}) {
    const double expected = std::exp(-static_cast<double>(lag) * kRow / 2.0);
    EXPECT_NEAR(covariance(belief, 3, lag, &PoseError::x), expected, 0.08) << lag;
  }
}

TEST(MeasuredWheelSpeeds, SpreadGrowsWithTheRootOfTheTravel) {
  PoseBelief belief;
  belief.wheel_noise = 0.03;
  const DriveGeometry drive{0.1, 0.4};
  constexpr int kSteps = 100;  // 1 m in 100 steps of 10 ms at 1 m/s
  constexpr int kDrives = 2000;
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < kDrives; ++seed) {
    double travel = 0.0;
    for (std::uint64_t i = 0; i < kSteps; ++i) {
      travel +=
          0.1 * 0.01 * measured_wheel_speeds(belief, drive, {10.0, 10.0}, 0.01, seed, 1, i).left;
    }
    sum += (travel - 1.0) * (travel - 1.0);
  }
  // Relative standard error of the spread: √(1/4000) = 1.6 %.
  EXPECT_NEAR(std::sqrt(sum / kDrives) / 0.03, 1.0, 0.08);
}

TEST(MeasuredWheelSpeeds, AreExactWhereTheRobotStands) {
  const WheelSpeeds measured = measured_wheel_speeds({}, {}, {0.0, 0.0}, 0.01, 1, 1, 0);
  EXPECT_EQ(measured.left, 0.0);
  EXPECT_EQ(measured.right, 0.0);
}

}  // namespace
}  // namespace tagfield
