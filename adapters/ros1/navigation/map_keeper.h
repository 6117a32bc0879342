// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reading, writing and publishing of a map.
#pragma once

#include <nav_msgs/GetMap.h>
#include <nav_msgs/MapMetaData.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>

#include <string>

#include "tagfield/map/occupancy_grid.h"

namespace tagfield {

/// Publishes a map on `map` and `map_metadata`, both latched, and serves it on request.
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

/// Reads a map file and logs its warnings; an empty map if `yaml_path` is "". Throws Error.
OccupancyGrid map_from_file(const std::string& yaml_path);

/// `map` with all cells occupied that overlap an occupied cell of `keep_out`.
OccupancyGrid with_occupied(OccupancyGrid map, const OccupancyGrid& keep_out);

/// Writes PATH (….yaml) and the image beside it, each atomically. Throws Error on failure.
void write_map(const OccupancyGrid& grid, const std::string& yaml_path);

}  // namespace tagfield
