// SPDX-License-Identifier: Apache-2.0
/// @file
/// A prismatic joint in Gazebo that follows given positions.
#pragma once

#include <gazebo/physics/PhysicsTypes.hh>
#include <string>

namespace tagfield {

/// Makes a joint follow the position given in each step: the motor runs at exactly the speed that
/// reaches the next position, so errors don't accumulate and the joint does not sag.
class LiftDrive {
 public:
  /// Throws Error if there is no such prismatic joint.
  LiftDrive(gazebo::physics::Model& model, const std::string& joint, double force_n);

  /// Makes the joint reach `position` [m] after the next step of `seconds`.
  void go(double position, double seconds);
  [[nodiscard]] double position() const;  ///< [m]
  [[nodiscard]] double speed() const;     ///< [m/s]

 private:
  gazebo::physics::JointPtr joint_;
  double force_n_;
};

}  // namespace tagfield
