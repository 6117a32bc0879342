// SPDX-License-Identifier: Apache-2.0
/// @file
/// ROS 1 topics of a robot and a lift.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "tagfield/motion/robot_reports.h"

namespace tagfield {

class RosLink;

/// The robot's topics: odom, ground_truth/odom, scan, path_finished, /tf, /tf_static; cmd_vel.
class RobotPublisher {
 public:
  RobotPublisher(const std::shared_ptr<RosLink>& link, RobotNames names);
  ~RobotPublisher();
  RobotPublisher(const RobotPublisher&) = delete;
  RobotPublisher& operator=(const RobotPublisher&) = delete;

  void publish(const OdometryReport& odometry);
  void publish(const MotionReport& motion);
  void publish(const ScanReport& scan);
  void publish_path_finished(bool finished);
  /// Publishes the static frames: the laser's on the base, if there is one, and the odometry frame
  /// in its parent.
  void publish_fixed_frames(Time now, const std::optional<RigidTransform>& X_BL,
                            const RigidTransform& X_WO);

  /// The newest command since the last call, with its numbers as received, even NaN.
  std::optional<BodyVelocity> take_command();

 private:
  class Topics;
  std::unique_ptr<Topics> topics_;
};

/// A lift's topics: joint_states; the commanded height.
class LiftPublisher {
 public:
  LiftPublisher(const std::shared_ptr<RosLink>& link, const std::string& name_space,
                const std::string& command_topic, std::string joint);
  ~LiftPublisher();
  LiftPublisher(const LiftPublisher&) = delete;
  LiftPublisher& operator=(const LiftPublisher&) = delete;

  /// Position [m] and speed [m/s] of the joint.
  void publish(Time stamp, double position, double speed);
  /// The newest commanded position [m] since the last call, as received.
  std::optional<double> take_command();

 private:
  class Topics;
  std::unique_ptr<Topics> topics_;
};

}  // namespace tagfield
