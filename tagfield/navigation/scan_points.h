// SPDX-License-Identifier: Apache-2.0
/// @file
/// A laser scan as points on the floor.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/laser/laser_scan.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

/// Frame R is the robot's base; the laser looks along the floor, so only x, y and yaw of X_RL
/// count.
struct ScanPoints {
  Eigen::Vector2d sensor_R = Eigen::Vector2d::Zero();
  std::vector<Eigen::Vector2d> ends_R;   ///< Where beams met something.
  std::vector<Eigen::Vector2d> clear_R;  ///< How far the others are known to be free.
};

/// The beams of `scan`, which are taken as of one moment. A beam that met nothing is clear up to
/// `most_clear_m`, or the laser's range if that is less; invalid beams, such as of NaN, are left
/// out, and so are all of a scan whose angles are not finite.
ScanPoints scan_points(const LaserScan& scan, const RigidTransform& X_RL, double most_clear_m);

/// Points such that no two neighbours in order are nearer to each other than `spacing_m`: where
/// beams lie dense, near the laser, they would outweigh all others.
std::vector<Eigen::Vector2d> thinned(const std::vector<Eigen::Vector2d>& points, double spacing_m);

/// Where about `beams` of the scan's beams, evenly, met something, in single precision. Left out
/// are ends that are not farther than `apart_m` from the one before, and those right after a beam
/// without an end, which may be of an edge; the last beam's is kept. Angles must be finite.
std::vector<Eigen::Vector2f> sparse_ends(const LaserScan& scan, const RigidTransform& X_RL,
                                         int beams, double apart_m);

}  // namespace tagfield
