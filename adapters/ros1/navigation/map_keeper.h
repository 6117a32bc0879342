// SPDX-License-Identifier: Apache-2.0
/// @file
/// A map that comes from a file or goes into one, and is told to whoever asks.
#pragma once

#include <nav_msgs/GetMap.h>
#include <nav_msgs/MapMetaData.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>

#include <string>

#include "tagfield/map/occupancy_grid.h"

namespace tagfield {

/// Publishes a map on `map` and `map_metadata`, latched both, and answers a service with it.
class MapTeller {
 public:
  MapTeller(ros::NodeHandle& node, const std::string& service, std::string frame);
  void tell(const OccupancyGrid& grid);
  [[nodiscard]] bool has_map() const { return !latest_.data.empty(); }

 private:
  bool answer(nav_msgs::GetMap::Request&, nav_msgs::GetMap::Response& response);

  std::string frame_;
  nav_msgs::OccupancyGrid latest_;
  ros::Publisher map_;
  ros::Publisher metadata_;
  ros::ServiceServer service_;
};

/// Reads a map file and tells its warnings; an empty map where `yaml_path` is "". Throws Error.
OccupancyGrid map_from_file(const std::string& yaml_path);

/// `map` with all cells occupied that an occupied one of `keep_out` overlaps.
OccupancyGrid with_occupied(OccupancyGrid map, const OccupancyGrid& keep_out);

/// Writes PATH (….yaml) and the image beside it, each in one step. Throws Error if that can't be
/// done.
void write_map(const OccupancyGrid& grid, const std::string& yaml_path);

}  // namespace tagfield
