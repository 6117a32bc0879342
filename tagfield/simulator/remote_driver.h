// SPDX-License-Identifier: Apache-2.0
/// @file
/// A simulated robot that somebody outside drives: velocities in, wheels and laser out.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "tagfield/motion/robot_reports.h"
#include "tagfield/navigation/goal_driver.h"
#include "tagfield/scenario/navigation_spec.h"
#include "tagfield/simulator/robot_senses.h"

namespace tagfield {

/// Who drives. All calls come from the thread that simulates.
class RemoteControl {
 public:
  RemoteControl() = default;
  virtual ~RemoteControl() = default;
  RemoteControl(const RemoteControl&) = delete;
  RemoteControl& operator=(const RemoteControl&) = delete;

  /// The velocity that the robot is to have from `now` on, as far as its limits let it.
  virtual BodyVelocity wanted(Time now) = 0;
  /// By the wheels, with their errors: X_OR at the stamp, and the mean velocity over the step
  /// before. Frame O is where the robot started.
  virtual void on_odometry(const OdometryReport& report) = 0;
  virtual void on_scan(const LaserScan& scan) = 0;
};

/// Which robot of a scenario is driven, by whom, and in what world.
struct RemoteDriving {
  std::string robot;
  std::shared_ptr<RemoteControl> control;
  LaserWorld world;
};

/// The robot's side of it. Walls don't stop it: whoever drives has a laser.
class RemoteDriver {
 public:
  RemoteDriver(const RemoteDriving& driving, const NavigationSpec& navigation, std::uint64_t seed,
               std::uint64_t key);

  /// As SelfDriver::step().
  BodyVelocity step(const PlanarPose& begin_W, Time now, double seconds);
  /// X_OR by the wheels, `seconds` after the present step's beginning.
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
