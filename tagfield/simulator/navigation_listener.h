// SPDX-License-Identifier: Apache-2.0
/// @file
/// Listener for the maps, scans and beliefs of robots that navigate by themselves.
#pragma once

#include <string>

#include "tagfield/laser/laser_scan.h"
#include "tagfield/map/occupancy_grid.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield {

/// All calls come from the simulation thread. The map's frame M is the world's.
class NavigationListener {
 public:
  NavigationListener() = default;
  virtual ~NavigationListener() = default;
  NavigationListener(const NavigationListener&) = delete;
  NavigationListener& operator=(const NavigationListener&) = delete;

  /// The map that robots navigate with, made by a robot or given; called before the first scan.
  virtual void on_map(const OccupancyGrid& map) = 0;
  /// pose_M is the robot's believed pose at the scan's timestamp.
  virtual void on_scan(const std::string& robot, const PlanarPose& pose_M,
                       const LaserScan& scan) = 0;
};

}  // namespace tagfield
