// SPDX-License-Identifier: Apache-2.0
/// @file
/// Kinematics of a skid-steered robot, the paper's eqs. (6)–(8), and how it is driven.
#pragma once

#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

/// The robot's pose in the floor plane: q = [X, Y, Θ]ᵀ of eq. (6).
struct PlanarPose {
  double x = 0.0;    ///< [m, world]
  double y = 0.0;    ///< [m, world]
  double yaw = 0.0;  ///< [rad], not wrapped.
};

/// Angular velocities of the left and right wheels, ω_L and ω_R [rad/s].
struct WheelSpeeds {
  double left = 0.0;
  double right = 0.0;
};

/// Velocities of the body [m/s, rad/s].
struct BodyVelocity {
  double forward = 0.0;
  double turn = 0.0;
};

/// Wheel geometry; the defaults are those of a Pioneer P3-AT.
struct DriveGeometry {
  double wheel_radius_m = 0.111;
  double track_m = 0.4;  ///< d: between the centres of the left and right wheels.
};

/// Limits and style of driving; the defaults suit a P3-AT.
struct DrivingStyle {
  double speed_m_s = 0.3;       ///< Along the path.
  double max_turn_rad_s = 1.0;  ///< Limit of |ω|.
  double look_ahead_m = 0.5;    ///< How far ahead on the path the robot aims.
};

/// Eqs. (7) and (8): v = r(ω_R + ω_L)/2, ω = r(ω_R − ω_L)/d.
BodyVelocity body_velocity(const DriveGeometry& drive, const WheelSpeeds& wheels);

/// Wheel speeds that give `velocity`: the inverse of body_velocity.
WheelSpeeds wheel_speeds(const DriveGeometry& drive, const BodyVelocity& velocity);

/// The arc that a robot drives with constant wheel speeds.
struct Arc {
  double chord_m = 0.0;  ///< Between its ends, along the mean heading.
  double turned_rad = 0.0;
};
Arc arc_of(const BodyVelocity& velocity, double seconds);

/// Eq. (6) integrated along an arc, exactly.
PlanarPose advance(const PlanarPose& pose, const Arc& arc);
/// Same, over `seconds` of constant wheel speeds.
PlanarPose advance(const PlanarPose& pose, const BodyVelocity& velocity, double seconds);

/// The pose in the world, on the floor.
inline RigidTransform to_transform(const PlanarPose& pose) {
  return from_planar(pose.x, pose.y, pose.yaw);
}

}  // namespace tagfield
