// SPDX-License-Identifier: Apache-2.0
#include "tagfield/motion/unicycle.h"

#include <cmath>

#include "tagfield/base/trigonometry.h"

namespace tagfield {

BodyVelocity body_velocity(const DriveGeometry& drive, const WheelSpeeds& wheels) {
  return {drive.wheel_radius_m * (wheels.right + wheels.left) / 2.0,
          drive.wheel_radius_m * (wheels.right - wheels.left) / drive.track_m};
}

WheelSpeeds wheel_speeds(const DriveGeometry& drive, const BodyVelocity& velocity) {
  const double half_difference = velocity.turn * drive.track_m / 2.0;
  return {(velocity.forward - half_difference) / drive.wheel_radius_m,
          (velocity.forward + half_difference) / drive.wheel_radius_m};
}

Arc arc_of(const BodyVelocity& velocity, double seconds) {
  const double turned = velocity.turn * seconds;
  // Chord of the arc: length v·t·sin(θ/2)/(θ/2).
  const double half = turned / 2.0;
  const double shortening = std::abs(half) < 1e-6 ? 1.0 - half * half / 6.0 : sine(half) / half;
  return {velocity.forward * seconds * shortening, turned};
}

PlanarPose advance(const PlanarPose& pose, const Arc& arc) {
  const auto [s, c] = sine_cosine(pose.yaw + arc.turned_rad / 2.0);
  return {pose.x + arc.chord_m * c, pose.y + arc.chord_m * s, pose.yaw + arc.turned_rad};
}

PlanarPose advance(const PlanarPose& pose, const BodyVelocity& velocity, double seconds) {
  return advance(pose, arc_of(velocity, seconds));
}

}  // namespace tagfield
