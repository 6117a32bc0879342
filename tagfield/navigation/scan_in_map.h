// SPDX-License-Identifier: Apache-2.0
/// @file
/// A laser scan as the robot's driving needs it: where its beams ended on the map, and how far the
/// floor is clear in a direction.
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

/// Frames: M the map, L the laser, which looks along the floor.
struct ScanInMap {
  Time stamp;
  PlanarPose q_ML;  ///< Where the laser was at the stamp.
  std::vector<ScanReturn> returns;
  /// For each beam how far it is clear [m]; 0 where it is invalid.
  std::vector<double> clear_m;
  double first_angle_rad = 0.0;
  double angle_step_rad = 0.0;
  double valid_share = 0.0;  ///< Of all beams.
  /// Where something nearer than the laser's least range may be: on each row of neighbouring
  /// invalid beams that is wider than kLeastBlind, points at that range.
  std::vector<Eigen::Vector2d> may_be_M;

  static constexpr double kLeastBlind = 0.09;  ///< [rad], about 5°.

  /// Least of clear_m within `half_width_rad` of the direction from the laser to `p_M`; 0 outside
  /// of the laser's view.
  [[nodiscard]] double clear_towards(const Eigen::Vector2d& p_M, double half_width_rad) const;
};

/// `pose_M` is the robot's at the scan's stamp; a scan whose beams are taken one after another is
/// straightened by the robot's velocity. `scan` may be anything, empty too; `pose_M` is finite.
ScanInMap scan_in_map(const LaserScan& scan, const RigidTransform& X_RL, const PlanarPose& pose_M,
                      const BodyVelocity& velocity);

}  // namespace tagfield
