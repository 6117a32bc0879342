/// @file
/// What a robot and a lift tell on ROS 1, and what they are told.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

class RosLink;

/// Names of a robot's topics and frames.
struct RobotNames {
  std::string name_space;
  std::string base = "base_link";
  std::string odom = "odom";
  std::string laser = "laser";
  std::string odom_parent;  ///< "" for none.
  bool publish_tf = true;
};

/// Wheel odometry at one time.
struct OdometryReport {
  Time stamp;
  PlanarPose pose;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< Of x, y, yaw.
  BodyVelocity velocity;
  Eigen::Vector2d velocity_variance = Eigen::Vector2d::Zero();  ///< Of forward and turn.
};

/// True motion at one time.
struct MotionReport {
  Time stamp;
  RigidTransform X_WB;
  Eigen::Vector3d linear_B = Eigen::Vector3d::Zero();   ///< [m/s], in the base's axes.
  Eigen::Vector3d angular_B = Eigen::Vector3d::Zero();  ///< [rad/s], in the base's axes.
};

/// One reading of a laser scanner.
struct ScanReport {
  Time stamp;
  double first_angle_rad = 0.0;
  double last_angle_rad = 0.0;
  double interval_s = 0.0;  ///< To the next reading.
  double least_range_m = 0.0;
  double most_range_m = 0.0;
  std::vector<float> ranges_m;
};

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
