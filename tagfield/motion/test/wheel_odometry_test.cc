// SPDX-License-Identifier: Apache-2.0
#include "tagfield/motion/wheel_odometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr DriveGeometry kDrive{0.1, 0.5};

TEST(WheelOdometry, DrivesACircle) {
  // Wheels that turn 9 rad and 11 rad move 1 m ahead and turn 0.4 rad, so radius 2.5 m.
  WheelOdometry odometry({kDrive});
  for (int i = 0; i <= 100; ++i) odometry.update({5.0 + 0.09 * i, -3.0 + 0.11 * i});
  EXPECT_NEAR(odometry.pose().yaw, 0.4, 1e-12);
  EXPECT_NEAR(odometry.pose().x, 2.5 * std::sin(0.4), 1e-12);
  EXPECT_NEAR(odometry.pose().y, 2.5 * (1.0 - std::cos(0.4)), 1e-12);
  EXPECT_NEAR(odometry.travel().forward, 1.0, 1e-12);
  EXPECT_NEAR(odometry.travel().turn, 0.4, 1e-12);
}

TEST(WheelOdometry, BeginsWhereTheFirstAnglesAre) {
  WheelOdometry odometry({kDrive});
  odometry.update({100.0, -30.0});
  EXPECT_EQ(odometry.pose().x, 0.0);
  EXPECT_EQ(odometry.pose().yaw, 0.0);
}

TEST(WheelOdometry, EncodersLoseLessThanATick) {
  WheelOdometry odometry({kDrive, kTwoPi / 500.0});
  for (int i = 0; i <= 12'345; ++i) odometry.update({0.001 * i, 0.001 * i});
  const double tick_m = kTwoPi / 500.0 * kDrive.wheel_radius_m;
  EXPECT_LE(odometry.pose().x, 1.2345);
  EXPECT_GT(odometry.pose().x, 1.2345 - tick_m);
  EXPECT_EQ(odometry.pose().y, 0.0);
}

TEST(WheelOdometry, GoesBackTheWayItCame) {
  WheelOdometry odometry({kDrive, kTwoPi / 500.0});
  for (int i = 0; i <= 5000; ++i) odometry.update({0.001 * i, 0.0012 * i});
  for (int i = 5000; i >= 0; --i) odometry.update({0.001 * i, 0.0012 * i});
  EXPECT_NEAR(odometry.pose().x, 0.0, 1e-9);
  EXPECT_NEAR(odometry.pose().y, 0.0, 1e-9);
  EXPECT_NEAR(odometry.pose().yaw, 0.0, 1e-9);
}

TEST(WheelOdometry, CovarianceIsThatOfNoisyWheels) {
  // Compares with a sample of robots whose sides travel with errors of σ = k √d.
  constexpr double kNoise = 0.01;
  constexpr int kRobots = 4000;
  constexpr int kSteps = 100;
  constexpr WheelAngles kStep{0.09, 0.11};
  WheelOdometry stated({kDrive, 0.0, kNoise});
  for (int i = 0; i <= kSteps; ++i) stated.update({kStep.left * i, kStep.right * i});

  std::mt19937 generator(7);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same sample each time
  std::normal_distribution<double> normal;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int robot = 0; robot < kRobots; ++robot) {
    WheelOdometry odometry({kDrive});
    WheelAngles angles;
    odometry.update(angles);
    for (int i = 0; i < kSteps; ++i) {
      const double r = kDrive.wheel_radius_m;
      angles.left += kStep.left + kNoise * std::sqrt(kStep.left * r) / r * normal(generator);
      angles.right += kStep.right + kNoise * std::sqrt(kStep.right * r) / r * normal(generator);
      odometry.update(angles);
    }
    const Eigen::Vector3d error(odometry.pose().x - stated.pose().x,
                                odometry.pose().y - stated.pose().y,
                                odometry.pose().yaw - stated.pose().yaw);
    sum += error * error.transpose();
  }
  const Eigen::Matrix3d sample = sum / kRobots;
  for (int i = 0; i < 3; ++i) {
    // The relative σ of a variance from n draws is √(2/n) = 2.2 %.
    EXPECT_NEAR(sample(i, i), stated.covariance()(i, i), 0.1 * stated.covariance()(i, i)) << i;
  }
}

}  // namespace
}  // namespace tagfield
