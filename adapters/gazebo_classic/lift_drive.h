// SPDX-License-Identifier: Apache-2.0
/// @file
/// A prismatic joint in Gazebo that is driven along set positions.
#pragma once

#include <gazebo/physics/PhysicsTypes.hh>
#include <string>

namespace tagfield {

/// Keeps a joint on the positions that it is given step by step: its motor gets just the speed that
/// brings it to the next one, so errors don't add up and it does not sag.
class LiftDrive {
 public:
  /// Throws Error if there is no such prismatic joint.
  LiftDrive(gazebo::physics::Model& model, const std::string& joint, double force_n);

  /// To be at `position` [m] after the next step of `seconds`.
  void go(double position, double seconds);
  [[nodiscard]] double position() const;  ///< [m]
  [[nodiscard]] double speed() const;     ///< [m/s]

 private:
  gazebo::physics::JointPtr joint_;
  double force_n_;
};

}  // namespace tagfield
