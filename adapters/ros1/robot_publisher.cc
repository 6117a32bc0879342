// SPDX-License-Identifier: Apache-2.0
// In C++17, which is the newest that the headers of Debian 11's and Noetic's messages compile with.
#include "adapters/ros1/robot_publisher.h"

#include <geometry_msgs/Twist.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Float64.h>
#include <tf2_msgs/TFMessage.h>

#include <array>
#include <mutex>
#include <utility>

#include "adapters/ros1/messages.h"
#include "adapters/ros1/ros_link.h"

namespace tagfield {
namespace {

/// Variance of the quantities that odometry on a floor does not measure: height, roll, pitch.
constexpr double kFloorVariance = 1e-6;

/// Rows and columns of ROS' covariances are x, y, z, roll, pitch, yaw.
constexpr std::size_t entry(std::size_t row, std::size_t column) { return 6 * row + column; }

void set_pose_covariance(const Eigen::Matrix3d& planar, nav_msgs::Odometry& message) {
  constexpr std::array<std::size_t, 3> kAxes = {0, 1, 5};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      message.pose.covariance[entry(kAxes.at(static_cast<std::size_t>(row)),
                                    kAxes.at(static_cast<std::size_t>(column)))] =
          planar(row, column);
    }
  }
  for (const std::size_t axis : {2U, 3U, 4U}) {
    message.pose.covariance[entry(axis, axis)] = kFloorVariance;
  }
}

void set_twist_covariance(const Eigen::Vector2d& variance, nav_msgs::Odometry& message) {
  for (const std::size_t axis : {1U, 2U, 3U, 4U}) {
    message.twist.covariance[entry(axis, axis)] = kFloorVariance;
  }
  message.twist.covariance[entry(0, 0)] = variance.x();
  message.twist.covariance[entry(5, 5)] = variance.y();
}

/// The last message of a topic that has not been taken yet. One thread puts, another takes.
template <class Value>
class Mailbox {
 public:
  void put(const Value& value) {
    const std::lock_guard<std::mutex> lock(mutex_);
    value_ = value;
  }
  std::optional<Value> take() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(value_, std::nullopt);
  }

 private:
  std::mutex mutex_;
  std::optional<Value> value_;
};

}  // namespace

class RobotPublisher::Topics {
 public:
  Topics(RosLink& link, RobotNames given) : names(std::move(given)) {
    const std::string& space = names.name_space;
    odometry = link.advertise<nav_msgs::Odometry>({space, "odom", 50, false, true});
    truth = link.advertise<nav_msgs::Odometry>({space, "ground_truth/odom", 50, false, true});
    scan = link.advertise<sensor_msgs::LaserScan>({space, "scan", 30, false, true});
    path_finished = link.advertise<std_msgs::Bool>({space, "path_finished", 1, true, true});
    frames = link.advertise<tf2_msgs::TFMessage>({"", "/tf", 100, false, false});
    fixed_frames = link.advertise<tf2_msgs::TFMessage>({"", "/tf_static", 100, true, false});
    cmd_vel = link.subscribe<geometry_msgs::Twist>(
        {space, "cmd_vel", 1, false, false}, [box = commands](const geometry_msgs::Twist& twist) {
          box->put({twist.linear.x, twist.angular.z});
        });
  }

  RobotNames names;
  std::shared_ptr<Mailbox<BodyVelocity>> commands = std::make_shared<Mailbox<BodyVelocity>>();
  std::shared_ptr<RosPublisher<nav_msgs::Odometry>> odometry;
  std::shared_ptr<RosPublisher<nav_msgs::Odometry>> truth;
  std::shared_ptr<RosPublisher<sensor_msgs::LaserScan>> scan;
  std::shared_ptr<RosPublisher<std_msgs::Bool>> path_finished;
  std::shared_ptr<RosPublisher<tf2_msgs::TFMessage>> frames;
  std::shared_ptr<RosPublisher<tf2_msgs::TFMessage>> fixed_frames;

 private:
  std::shared_ptr<RosSubscriber<geometry_msgs::Twist>> cmd_vel;
};

RobotPublisher::RobotPublisher(const std::shared_ptr<RosLink>& link, RobotNames names)
    : topics_(std::make_unique<Topics>(*link, std::move(names))) {}

RobotPublisher::~RobotPublisher() = default;

std::optional<BodyVelocity> RobotPublisher::take_command() { return topics_->commands->take(); }

void RobotPublisher::publish(const OdometryReport& odometry) {
  const RigidTransform X_OB = to_transform(odometry.pose);
  nav_msgs::Odometry message;
  message.header.stamp = to_ros(odometry.stamp);
  message.header.frame_id = topics_->names.odom;
  message.child_frame_id = topics_->names.base;
  message.pose.pose = pose_message(X_OB);
  message.twist.twist.linear.x = odometry.velocity.forward;
  message.twist.twist.angular.z = odometry.velocity.turn;
  set_pose_covariance(odometry.covariance, message);
  set_twist_covariance(odometry.velocity_variance, message);
  topics_->odometry->publish(message);
  if (!topics_->names.publish_tf) return;
  tf2_msgs::TFMessage frames;
  frames.transforms = {
      frame_message(odometry.stamp, topics_->names.odom, topics_->names.base, X_OB)};
  topics_->frames->publish(frames);
}

void RobotPublisher::publish(const MotionReport& motion) {
  nav_msgs::Odometry message;
  message.header.stamp = to_ros(motion.stamp);
  message.header.frame_id = "world";
  message.child_frame_id = topics_->names.base;
  message.pose.pose = pose_message(motion.X_WB);
  message.twist.twist.linear = vector_message(motion.linear_B);
  message.twist.twist.angular = vector_message(motion.angular_B);
  topics_->truth->publish(message);
}

void RobotPublisher::publish(const ScanReport& scan) {
  sensor_msgs::LaserScan message;
  message.header.stamp = to_ros(scan.stamp);
  message.header.frame_id = topics_->names.laser;
  const auto steps = static_cast<double>(scan.ranges_m.size()) - 1.0;
  const double increment = steps > 0.0 ? (scan.last_angle_rad - scan.first_angle_rad) / steps : 0.0;
  message.angle_min = static_cast<float>(scan.first_angle_rad);
  message.angle_max = static_cast<float>(scan.last_angle_rad);
  message.angle_increment = static_cast<float>(increment);
  message.scan_time = static_cast<float>(scan.interval_s);
  message.range_min = static_cast<float>(scan.min_range_m);
  message.range_max = static_cast<float>(scan.max_range_m);
  message.ranges = scan.ranges_m;
  topics_->scan->publish(message);
}

void RobotPublisher::publish_path_finished(bool finished) {
  std_msgs::Bool message;
  message.data = finished ? 1 : 0;
  topics_->path_finished->publish(message);
}

void RobotPublisher::publish_fixed_frames(Time now, const std::optional<RigidTransform>& X_BL,
                                          const RigidTransform& X_WO) {
  tf2_msgs::TFMessage frames;
  if (X_BL)
    frames.transforms.push_back(
        frame_message(now, topics_->names.base, topics_->names.laser, *X_BL));
  if (!topics_->names.odom_parent.empty()) {
    frames.transforms.push_back(
        frame_message(now, topics_->names.odom_parent, topics_->names.odom, X_WO));
  }
  if (topics_->names.publish_tf && !frames.transforms.empty())
    topics_->fixed_frames->publish(frames);
}

class LiftPublisher::Topics {
 public:
  Topics(RosLink& link, const std::string& space, const std::string& command_topic,
         std::string joint_name)
      : joint(std::move(joint_name)) {
    states = link.advertise<sensor_msgs::JointState>({space, "joint_states", 50, false, false});
    command = link.subscribe<std_msgs::Float64>(
        {space, command_topic, 1, false, false},
        [box = commands](const std_msgs::Float64& height) { box->put(height.data); });
  }

  std::string joint;
  std::shared_ptr<Mailbox<double>> commands = std::make_shared<Mailbox<double>>();
  std::shared_ptr<RosPublisher<sensor_msgs::JointState>> states;

 private:
  std::shared_ptr<RosSubscriber<std_msgs::Float64>> command;
};

LiftPublisher::LiftPublisher(const std::shared_ptr<RosLink>& link, const std::string& name_space,
                             const std::string& command_topic, std::string joint)
    : topics_(std::make_unique<Topics>(*link, name_space, command_topic, std::move(joint))) {}

LiftPublisher::~LiftPublisher() = default;

std::optional<double> LiftPublisher::take_command() { return topics_->commands->take(); }

void LiftPublisher::publish(Time stamp, double position, double speed) {
  sensor_msgs::JointState message;
  message.header.stamp = to_ros(stamp);
  message.name = {topics_->joint};
  message.position = {position};
  message.velocity = {speed};
  topics_->states->publish(message);
}

}  // namespace tagfield
