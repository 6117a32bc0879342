#include "adapters/ros2/ros2_robot.h"

#include <cmath>
#include <limits>
#include <utility>

#include "adapters/ros2/internal/to_message.h"

namespace tagfield::ros2 {
namespace {

/// Odometry and its frame come at 50 Hz at the most.
constexpr Duration kOdometryInterval = std::chrono::milliseconds(20);
/// Without a newer command the robot stops: whoever drives may be gone.
constexpr Duration kCommandLife = std::chrono::milliseconds(500);

float range_of(const LaserScan& scan, float range_m) {
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  switch (beam_of(scan, range_m)) {
    case Beam::kReturn:
      return range_m;
    case Beam::kNothing:
      return kInfinite;
    default:
      return -kInfinite;
  }
}

bool is_finite(const geometry_msgs::Twist& twist) {
  return std::isfinite(twist.linear.x) && std::isfinite(twist.angular.z);
}

}  // namespace

sensor_msgs::LaserScan scan_message(const LaserScan& scan, const std::string& frame,
                                    double rate_hz) {
  sensor_msgs::LaserScan message;
  message.header = header_message(scan.stamp, frame);
  message.angle_min = static_cast<float>(scan.first_angle_rad);
  message.angle_max = static_cast<float>(beam_angle(scan, scan.ranges_m.size() - 1));
  message.angle_increment = static_cast<float>(scan.angle_step_rad);
  message.time_increment = static_cast<float>(to_seconds(scan.beam_interval));
  message.scan_time = static_cast<float>(1.0 / rate_hz);
  message.range_min = static_cast<float>(scan.least_range_m);
  message.range_max = static_cast<float>(scan.most_range_m);
  message.ranges.reserve(scan.ranges_m.size());
  for (const float range_m : scan.ranges_m) message.ranges.push_back(range_of(scan, range_m));
  return message;
}

Ros2Robot::Ros2Robot(std::shared_ptr<DdsSink> sink, std::shared_ptr<Ros2Outlet> outlet,
                     const LaserParameters& laser, std::function<void(const std::string&)> warn)
    : sink_(std::move(sink)),
      outlet_(std::move(outlet)),
      laser_(laser),
      warn_(std::move(warn)),
      commands_(sink_->subscribe_twist("/cmd_vel")),
      odometry_(*sink_, {"/odom"}),
      scans_(*sink_, {"/scan", Delivery::kBestEffort}),
      tf_(*sink_, {"/tf"}),
      static_tf_(*sink_, {"/tf_static", Delivery::kLatched}) {
  static_tf_.publish({}, {{frame_message({}, kBaseFrame, kLaserFrame, laser_.X_RL)}});
}

BodyVelocity Ros2Robot::wanted(Time now) {
  if (const auto twist = sink_->take_twist(commands_)) {
    if (is_finite(*twist)) {
      command_ = {twist->linear.x, twist->angular.z};
      commanded_ = now;
    } else if (warn_) {
      std::exchange(warn_, nullptr)("/cmd_vel: a command that is not finite was left out");
    }
  }
  if (commanded_ == Time::min() || now - commanded_ > kCommandLife) command_ = {};
  return command_;
}

void Ros2Robot::on_odometry(Time stamp, const PlanarPose& pose_O, const BodyVelocity& velocity) {
  outlet_->tell_time(stamp);
  if (told_ != Time::min() && stamp - told_ < kOdometryInterval) return;
  told_ = stamp;
  const RigidTransform X_OB = to_transform(pose_O);
  nav_msgs::Odometry message;
  message.header = header_message(stamp, kOdomFrame);
  message.child_frame_id = kBaseFrame;
  message.pose.pose = pose_message(X_OB);
  message.twist.twist.linear.x = velocity.forward;
  message.twist.twist.angular.z = velocity.turn;
  odometry_.publish(stamp, message);
  tf_.publish(stamp, {{frame_message(stamp, kOdomFrame, kBaseFrame, X_OB)}});
}

void Ros2Robot::on_scan(const LaserScan& scan) {
  scans_.publish(scan.stamp, scan_message(scan, kLaserFrame, laser_.rate_hz));
}

}  // namespace tagfield::ros2
