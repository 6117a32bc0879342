// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/ros2_robot.h"

#include <cmath>
#include <utility>

#include "adapters/ros2/internal/to_message.h"

namespace tagfield::ros2 {
namespace {

/// Odometry and its frame are published at 50 Hz at most.
constexpr Duration kOdometryInterval = std::chrono::milliseconds(20);
/// Without a newer command the robot stops, as the driving program may have exited.
constexpr Duration kCommandLife = std::chrono::milliseconds(500);

bool is_finite(const geometry_msgs::Twist& twist) {
  return std::isfinite(twist.linear.x) && std::isfinite(twist.angular.z);
}

}  // namespace

void Ros2Robot::Travel::add(const OdometryReport& report, double seconds) {
  moved.forward += report.velocity.forward * seconds;
  moved.turn += report.velocity.turn * seconds;
  variance += report.velocity_variance * seconds * seconds;
  duration_s += seconds;
}

void Ros2Robot::Travel::take_mean(OdometryReport& report) {
  if (duration_s > 0.0) {
    report.velocity = {moved.forward / duration_s, moved.turn / duration_s};
    report.velocity_variance = variance / (duration_s * duration_s);
  }
  *this = {};
}

Ros2Robot::Ros2Robot(std::shared_ptr<DdsSink> driver, std::shared_ptr<MessageSink> sink,
                     std::shared_ptr<Ros2Outlet> outlet, const LaserParameters& laser,
                     std::function<void(const std::string&)> warn)
    : driver_(std::move(driver)),
      sink_(std::move(sink)),
      outlet_(std::move(outlet)),
      laser_(laser),
      warn_(std::move(warn)),
      commands_(driver_->subscribe_twist("/cmd_vel")),
      odometry_(*sink_, {"/odom"}),
      scans_(*sink_, {"/scan", Delivery::kBestEffort}) {
  outlet_->tell_fixed_frame({}, frame_message({}, kBaseFrame, kLaserFrame, laser_.X_RL));
}

BodyVelocity Ros2Robot::wanted(Time now) {
  if (const auto twist = driver_->take_twist(commands_)) {
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

void Ros2Robot::on_odometry(const OdometryReport& report) {
  outlet_->tell_time(report.stamp);
  if (reported_ != Time::min()) travel_.add(report, to_seconds(report.stamp - reported_));
  reported_ = report.stamp;
  if (published_ != Time::min() && report.stamp - published_ < kOdometryInterval) return;
  published_ = report.stamp;
  OdometryReport averaged = report;
  travel_.take_mean(averaged);
  RobotNames names;
  names.odom = kOdomFrame;
  names.base = kBaseFrame;
  odometry_.publish(averaged.stamp, odometry_message(averaged, names));
  outlet_->tell_frame(averaged.stamp, frame_message(averaged.stamp, kOdomFrame, kBaseFrame,
                                                    to_transform(averaged.pose)));
}

void Ros2Robot::on_scan(const LaserScan& scan) {
  outlet_->tell_time(scan.stamp);
  scans_.publish(scan.stamp, scan_message(scan, kLaserFrame, laser_.rate_hz));
}

}  // namespace tagfield::ros2
