// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a robot and a lift tell on ROS 1, and what they are told.
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
  /// Tells the frames that don't move: the laser's on the base, where there is one, and that of the
  /// odometry in its parent.
  void publish_fixed_frames(Time now, const std::optional<RigidTransform>& X_BL,
                            const RigidTransform& X_WO);

  /// The newest command since the last call. Its numbers are as they came, NaN and all.
  std::optional<BodyVelocity> take_command();

 private:
  class Topics;
  std::unique_ptr<Topics> topics_;
};

/// A lift's topics: joint_states; the height to go to.
class LiftPublisher {
 public:
  LiftPublisher(const std::shared_ptr<RosLink>& link, const std::string& name_space,
                const std::string& command_topic, std::string joint);
  ~LiftPublisher();
  LiftPublisher(const LiftPublisher&) = delete;
  LiftPublisher& operator=(const LiftPublisher&) = delete;

  /// Position [m] and speed [m/s] of the joint.
  void publish(Time stamp, double position, double speed);
  /// The newest position to go to [m] since the last call, as it came.
  std::optional<double> take_command();

 private:
  class Topics;
  std::unique_ptr<Topics> topics_;
};

}  // namespace tagfield
