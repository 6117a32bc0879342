// SPDX-License-Identifier: Apache-2.0
/// @file
/// Laser scans freed of the robot's motion while the beams were swept.
#pragma once

#include <functional>

#include "tagfield/laser/laser_scan.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

/// Neighbouring beams are on one surface if their ranges differ by no more than this [m], noise for
/// the most part, …
inline constexpr double kSameSurfaceStep = 0.05;
/// … or if the surface through their ends is met at no less than this angle [rad].
inline constexpr double kLeastIncidence = 0.1745;

/// The scan as it would have been had all its beams been taken at once, at the time of its last
/// beam: its stamp is that time, its beam interval 0, its angles are the same. A scan of interval 0
/// is given back as it is.
///
/// `odometry_at` gives the robot's pose at the times of the beams, in any frame that stays the same
/// meanwhile; X_RL is the scanner's on the robot, upright or upside down. Each beam's end is moved
/// into the last beam's frame. The range at an angle is then that of the nearest straight piece
/// between the ends of two neighbouring returns on one surface, so that walls stay straight and
/// what comes before them hides them; a return that shares its surface with no neighbour stands at
/// the angle nearest to it. Between two beams that met nothing is nothing. Other angles, as at the
/// rims of things, have the range of the beam nearest in angle if that is within half a step, and 0
/// (invalid) else: what had been hidden, or left the field of view, nobody has seen. A beam whose
/// pose is not finite is invalid.
LaserScan deskewed(const LaserScan& scan, const std::function<PlanarPose(Time)>& odometry_at,
                   const RigidTransform& X_RL);

}  // namespace tagfield
