// SPDX-License-Identifier: Apache-2.0
/// @file
/// A laser scan as points on the floor.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/laser/laser_scan.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

/// Frame R is the robot's base; the laser scans parallel to the floor, so only x, y and yaw of X_RL
/// count.
struct ScanPoints {
  Eigen::Vector2d sensor_R = Eigen::Vector2d::Zero();
  std::vector<Eigen::Vector2d> ends_R;   ///< Where beams hit something.
  std::vector<Eigen::Vector2d> clear_R;  ///< Up to where the other beams are known to be free.
};

/// The beams of `scan`, treated as simultaneous. A beam without a hit is clear up to
/// `max_clear_m`, or the laser's range if that is less. Invalid beams, such as NaN, are left out,
/// and so are all beams of a scan whose angles are not finite.
ScanPoints scan_points(const LaserScan& scan, const RigidTransform& X_RL, double max_clear_m);

/// A subset of the points such that no two consecutive ones are nearer to each other than
/// `spacing_m`: where beams are dense, near the laser, they would outweigh all others.
std::vector<Eigen::Vector2d> thinned(const std::vector<Eigen::Vector2d>& points, double spacing_m);

/// Endpoints of about `beams` evenly spaced beams of the scan, in single precision. Leaves out
/// endpoints not farther than `apart_m` from the one before, and those right after a beam without a
/// hit, which may be at an edge; the last beam's is kept. Angles must be finite.
std::vector<Eigen::Vector2f> sparse_ends(const LaserScan& scan, const RigidTransform& X_RL,
                                         int beams, double apart_m);

}  // namespace tagfield
