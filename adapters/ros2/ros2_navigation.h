// SPDX-License-Identifier: Apache-2.0
/// @file
/// Maps and laser scans as ROS 2 messages, and an outlet for robots that navigate autonomously.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "adapters/ros2/ros2_outlet.h"
#include "tagfield/laser/simulated_laser.h"
#include "tagfield/simulator/navigation_listener.h"

namespace tagfield::ros2 {

/// +inf for a beam without return, -inf for one too near (REP-117).
sensor_msgs::LaserScan scan_message(const LaserScan& scan, const std::string& frame,
                                    double rate_hz);

/// The grid in the map's frame, stamped 0.
nav_msgs::OccupancyGrid grid_message(const OccupancyGrid& grid);

/// Publishes for robots that navigate autonomously: /map once, latched; for each robot /ROBOT/scan,
/// in /tf its frame ROBOT/base_link in the map at the scans' stamps, as it believes, and in
/// /tf_static ROBOT/laser on it.
class Ros2Navigation : public NavigationListener {
 public:
  /// `outlet` publishes the frames.
  Ros2Navigation(std::shared_ptr<MessageSink> sink, std::shared_ptr<Ros2Outlet> outlet,
                 const LaserParameters& laser);

  void on_map(const OccupancyGrid& map) override;
  void on_scan(const std::string& robot, const PlanarPose& pose_M, const LaserScan& scan) override;

 private:
  using Scans = Publisher<sensor_msgs::LaserScan>;

  const Scans& scans_of(const std::string& robot);

  std::shared_ptr<MessageSink> sink_;
  std::shared_ptr<Ros2Outlet> outlet_;
  LaserParameters laser_;
  Publisher<nav_msgs::OccupancyGrid> map_;
  std::map<std::string, Scans> scans_;  ///< By robot.
};

}  // namespace tagfield::ros2
