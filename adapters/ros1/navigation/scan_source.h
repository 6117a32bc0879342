// SPDX-License-Identifier: Apache-2.0
/// @file
/// Laser scans together with the robot's pose by odometry.
#pragma once

#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>

#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "adapters/ros1/navigation/frame_listener.h"
#include "tagfield/laser/laser_scan.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

struct LocatedScan {
  LaserScan scan;
  PlanarPose odometry;  ///< The robot's at the scan's stamp [odom].
  RigidTransform X_RL;  ///< The laser on the robot's base.
};

/// Passes on scans in order as soon as tf knows the robot's pose at their stamps. Scans whose pose
/// never becomes known, that are out of order or invalid are dropped with a warning.
class ScanSource {
 public:
  /// If `straighten`, scans swept by a moving robot are deskewed; their stamp is then that of the
  /// last beam.
  ScanSource(ros::NodeHandle& node, const FrameListener& frames, FrameNames names, bool straighten,
             std::function<void(const LocatedScan&)> on_scan);
  /// To be called when tf has changed.
  void try_again();
  void forget();

 private:
  struct Waiting {
    LaserScan scan;
    std::string frame;
  };

  void take(const sensor_msgs::LaserScan& message);
  [[nodiscard]] std::optional<LocatedScan> located(const Waiting& waiting) const;
  void drop_old();

  const FrameListener& frames_;
  FrameNames names_;
  bool straighten_;
  std::function<void(const LocatedScan&)> on_scan_;
  std::deque<Waiting> waiting_;
  Time last_;
  ros::Subscriber subscriber_;
};

}  // namespace tagfield
