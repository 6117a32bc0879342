// SPDX-License-Identifier: Apache-2.0
/// @file
/// The driven wheels of a robot in Gazebo, left and right.
#pragma once

#include <gazebo/physics/PhysicsTypes.hh>
#include <string>
#include <vector>

#include "tagfield/motion/unicycle.h"
#include "tagfield/motion/wheel_odometry.h"

namespace tagfield {

/// The wheels of one side: they all turn at the same speed, and the side's angle is the mean of
/// theirs.
class WheelSide {
 public:
  /// Throws Error, which names the parameter `key` that the names come from, if one of these joints
  /// is missing or is not revolute.
  WheelSide(gazebo::physics::Model& model, const char* key, const std::vector<std::string>& joints,
            double torque_nm);

  /// Makes the wheels turn at `speed` [rad/s] from the next step on.
  void turn(double speed);
  /// Mean angle [rad], unwrapped; to be called in each step.
  double angle();

 private:
  struct Wheel {
    gazebo::physics::JointPtr joint;
    double angle = 0.0;  ///< Unwrapped [rad].
  };

  std::vector<Wheel> wheels_;
  double torque_nm_;
};

/// Drives and reads both sides.
class SkidSteer {
 public:
  SkidSteer(WheelSide left, WheelSide right, const DriveGeometry& drive)
      : left_(std::move(left)), right_(std::move(right)), drive_(drive) {}

  void drive(const BodyVelocity& velocity);
  WheelAngles angles() { return {left_.angle(), right_.angle()}; }

 private:
  WheelSide left_;
  WheelSide right_;
  DriveGeometry drive_;
};

/// Makes `joint`'s motor run at `speed` [rad/s or m/s] with at most `effort` [N·m or N].
void run_motor(gazebo::physics::Joint& joint, double speed, double effort);

/// Throws Error if the world's physics engine is not ODE, whose joint motors drive wheels and
/// lifts.
void expect_ode(gazebo::physics::World& world);

}  // namespace tagfield
