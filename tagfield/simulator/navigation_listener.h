// SPDX-License-Identifier: Apache-2.0
/// @file
/// Who is told what robots know and see that find their way by themselves.
#pragma once

#include <string>

#include "tagfield/laser/laser_scan.h"
#include "tagfield/map/occupancy_grid.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield {

/// All calls come from the thread that simulates. The map's frame M is the world's.
class NavigationListener {
 public:
  NavigationListener() = default;
  virtual ~NavigationListener() = default;
  NavigationListener(const NavigationListener&) = delete;
  NavigationListener& operator=(const NavigationListener&) = delete;

  /// The map that robots drive by, before the first scan; made by a robot or given.
  virtual void on_map(const OccupancyGrid& map) = 0;
  /// pose_M is where the robot believes to have been at the scan's stamp.
  virtual void on_scan(const std::string& robot, const PlanarPose& pose_M,
                       const LaserScan& scan) = 0;
};

}  // namespace tagfield
