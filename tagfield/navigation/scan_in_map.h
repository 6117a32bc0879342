// SPDX-License-Identifier: Apache-2.0
/// @file
/// A laser scan as needed for driving: where its beams ended on the map, and how far the floor is
/// clear in each direction.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/laser/laser_scan.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

struct ScanReturn {
  Eigen::Vector2d point_M;
  double range_m = 0.0;
  std::size_t beam = 0;
};

/// Frames: M the map, L the laser, which scans parallel to the floor.
struct ScanInMap {
  Time stamp;
  PlanarPose q_ML;  ///< The laser's pose at the timestamp.
  std::vector<ScanReturn> returns;
  /// For each beam how far it is clear [m]; 0 if invalid.
  std::vector<double> clear_m;
  double first_angle_rad = 0.0;
  double angle_step_rad = 0.0;
  double valid_share = 0.0;  ///< Of all beams.
  /// Where there may be something nearer than the laser's minimum range: points at that range for
  /// each run of neighbouring invalid beams that is wider than kMinBlind.
  std::vector<Eigen::Vector2d> may_be_M;

  static constexpr double kMinBlind = 0.09;  ///< [rad], about 5°.

  /// Least of clear_m within `half_width_rad` of the direction from the laser to `p_M`; 0 outside
  /// the laser's field of view.
  [[nodiscard]] double clear_towards(const Eigen::Vector2d& p_M, double half_width_rad) const;
};

/// `pose_M` is the robot's pose at the scan's timestamp and must be finite. A scan whose beams are
/// taken one after another is deskewed with the robot's velocity. `scan` may be anything, even
/// empty.
ScanInMap scan_in_map(const LaserScan& scan, const RigidTransform& X_RL, const PlanarPose& pose_M,
                      const BodyVelocity& velocity);

}  // namespace tagfield
