// SPDX-License-Identifier: Apache-2.0
/// @file
/// Deskewing: removes the robot's motion during a sweep from laser scans.
#pragma once

#include <functional>

#include "tagfield/laser/laser_scan.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

/// Neighbouring beams share a surface if their ranges differ by at most this [m], mainly noise, …
inline constexpr double kSameSurfaceStep = 0.05;
/// … or if the angle between the beams and the surface through their ends is at least this [rad].
inline constexpr double kMinIncidence = 0.1745;

/// The scan as if all its beams had been taken simultaneously with the last one: its timestamp is
/// that of the last beam, its beam interval 0, its angles are unchanged. A scan with interval 0 is
/// returned unchanged.
///
/// `odometry_at` gives the robot's pose at the times of the beams, in any frame that is fixed
/// during the scan; X_RL is the scanner's pose on the robot, upright or upside down. Each beam's
/// end point is transformed into the last beam's frame. The range at an angle is then that of the
/// nearest line segment between the end points of two neighbouring returns on one surface, so that
/// walls stay straight and are hidden by objects in front of them. A return that shares its surface
/// with no neighbour is placed at the nearest angle. Between two beams without a hit, there is no
/// hit. Other angles, such as at the edges of objects, get the range of the beam nearest in angle
/// if it is within half a step, otherwise 0 (invalid), as areas that were occluded or outside the
/// field of view have not been observed. A beam whose pose is not finite is invalid.
LaserScan deskewed(const LaserScan& scan, const std::function<PlanarPose(Time)>& odometry_at,
                   const RigidTransform& X_RL);

}  // namespace tagfield
