// SPDX-License-Identifier: Apache-2.0
/// @file
/// A simulated robot with the interface that Nav2 and slam_toolbox expect: /cmd_vel in, /odom,
/// /scan and frames out.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "adapters/ros2/dds_sink.h"
#include "adapters/ros2/ros2_navigation.h"
#include "adapters/ros2/ros2_outlet.h"
#include "tagfield/laser/simulated_laser.h"
#include "tagfield/simulator/remote_driver.h"

namespace tagfield::ros2 {

// Frames according to REP-105; /tf has odom to base_link, /tf_static base_link to the laser. map to
// odom is left to the robot's localization.
inline constexpr const char* kOdomFrame = "odom";
inline constexpr const char* kBaseFrame = "base_link";
inline constexpr const char* kLaserFrame = "laser";

class Ros2Robot : public RemoteControl {
 public:
  /// Commands come from `driver`; messages go to `sink`. `outlet` publishes the clock and the
  /// frames. `warn` receives a line, once, if a command is unusable.
  Ros2Robot(std::shared_ptr<DdsSink> driver, std::shared_ptr<MessageSink> sink,
            std::shared_ptr<Ros2Outlet> outlet, const LaserParameters& laser,
            std::function<void(const std::string&)> warn);

  BodyVelocity wanted(Time now) override;
  void on_odometry(const OdometryReport& report) override;
  void on_scan(const LaserScan& scan) override;

 private:
  /// Travel by odometry since its last publication.
  struct Travel {
    BodyVelocity moved;  ///< [m], [rad]
    Eigen::Vector2d variance = Eigen::Vector2d::Zero();
    double duration_s = 0.0;

    void add(const OdometryReport& report, double seconds);
    /// Stores the mean velocity and its variance in a report, and resets.
    void take_mean(OdometryReport& report);
  };

  std::shared_ptr<DdsSink> driver_;
  std::shared_ptr<MessageSink> sink_;
  std::shared_ptr<Ros2Outlet> outlet_;
  LaserParameters laser_;
  std::function<void(const std::string&)> warn_;
  std::size_t commands_;
  Publisher<nav_msgs::Odometry> odometry_;
  Publisher<sensor_msgs::LaserScan> scans_;
  BodyVelocity command_;
  Time commanded_ = Time::min();
  Time reported_ = Time::min();
  Time published_ = Time::min();
  Travel travel_;
};

}  // namespace tagfield::ros2
