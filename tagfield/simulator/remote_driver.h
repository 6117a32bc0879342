// SPDX-License-Identifier: Apache-2.0
/// @file
/// A simulated robot driven remotely: velocities in, odometry and scans out.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "tagfield/motion/robot_reports.h"
#include "tagfield/navigation/goal_driver.h"
#include "tagfield/scenario/navigation_spec.h"
#include "tagfield/simulator/robot_senses.h"

namespace tagfield {

/// The remote driver. All calls come from the simulation thread.
class RemoteControl {
 public:
  RemoteControl() = default;
  virtual ~RemoteControl() = default;
  RemoteControl(const RemoteControl&) = delete;
  RemoteControl& operator=(const RemoteControl&) = delete;

  /// The commanded velocity from `now` on, which the robot follows within its limits.
  virtual BodyVelocity wanted(Time now) = 0;
  /// Wheel odometry, with its errors: X_OR at the timestamp, and the mean velocity over the
  /// previous step. Frame O is the robot's start pose.
  virtual void on_odometry(const OdometryReport& report) = 0;
  virtual void on_scan(const LaserScan& scan) = 0;
};

/// Which robot of a scenario is driven, by whom, and in which world.
struct RemoteDriving {
  std::string robot;
  std::shared_ptr<RemoteControl> control;
  LaserWorld world;
};

/// The robot's side. Walls don't stop it: avoiding them is up to the remote driver, which has the
/// scans.
class RemoteDriver {
 public:
  RemoteDriver(const RemoteDriving& driving, const NavigationSpec& navigation, std::uint64_t seed,
               std::uint64_t key);

  /// As SelfDriver::step().
  BodyVelocity step(const PlanarPose& begin_W, Time now, double seconds);
  /// X_OR by wheel odometry, `seconds` after the beginning of the current step.
  [[nodiscard]] PlanarPose odometry(double seconds) const { return senses_.odometry(seconds); }

 private:
  [[nodiscard]] OdometryReport report(Time now);

  std::shared_ptr<RemoteControl> control_;
  SpeedLimits limits_;
  OdometryNoise noise_;
  OdometryReport last_;
  RobotSenses senses_;
  BodyVelocity velocity_;
};

}  // namespace tagfield
