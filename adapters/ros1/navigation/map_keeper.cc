// SPDX-License-Identifier: Apache-2.0
// In C++17, which is the newest that the headers of Debian's and Noetic's messages compile with.
#include "adapters/ros1/navigation/map_keeper.h"

#include <algorithm>
#include <filesystem>

#include "adapters/ros1/navigation/navigation_messages.h"
#include "tagfield/files/files.h"
#include "tagfield/map/map_file.h"

namespace tagfield {
namespace {

/// Marks the cells within `half_m` of `centre` along x and y as occupied.
void occupy(OccupancyGrid& map, const Eigen::Vector2d& centre, double half_m) {
  const Eigen::Vector2i low = map.cell_of(centre.array() - half_m);
  const Eigen::Vector2i high = map.cell_of(centre.array() + half_m);
  for (int y = std::max(0, low.y()); y <= std::min(map.height - 1, high.y()); ++y) {
    for (int x = std::max(0, low.x()); x <= std::min(map.width - 1, high.x()); ++x) {
      map.cells[map.index(x, y)] = 100;
    }
  }
}

}  // namespace

MapTeller::MapTeller(ros::NodeHandle& node, const std::string& service, std::string frame)
    : frame_(std::move(frame)),
      map_(node.advertise<nav_msgs::OccupancyGrid>("map", 1, true)),
      metadata_(node.advertise<nav_msgs::MapMetaData>("map_metadata", 1, true)),
      service_(node.advertiseService(service, &MapTeller::answer, this)) {}

void MapTeller::tell(const OccupancyGrid& grid) {
  latest_ = grid_message(grid, frame_, ros::Time::now());
  map_.publish(latest_);
  metadata_.publish(latest_.info);
}

bool MapTeller::answer(nav_msgs::GetMap::Request&, nav_msgs::GetMap::Response& response) {
  if (!has_map()) return false;
  response.map = latest_;
  return true;
}

OccupancyGrid map_from_file(const std::string& yaml_path) {
  if (yaml_path.empty()) return {};
  Diagnostics diagnostics;
  OccupancyGrid map = read_map(yaml_path, diagnostics);
  for (const std::string& warning : diagnostics.warnings()) ROS_WARN("%s", warning.c_str());
  return map;
}

OccupancyGrid with_occupied(OccupancyGrid map, const OccupancyGrid& keep_out) {
  // Slightly less than half a cell, so that neighbours that it merely touches are unchanged.
  const double half_m = 0.499 * keep_out.resolution_m;
  for (int y = 0; y < keep_out.height; ++y) {
    for (int x = 0; x < keep_out.width; ++x) {
      if (is_occupied(keep_out.at(x, y))) {
        occupy(map, keep_out.centre_of(x, y), half_m);
      }
    }
  }
  return map;
}

void write_map(const OccupancyGrid& grid, const std::string& yaml_path) {
  const std::filesystem::path path(yaml_path);
  const std::string image = path.stem().string() + ".pgm";
  std::error_code ignored;  // If this fails, writing fails too.
  std::filesystem::create_directories(path.parent_path(), ignored);
  write_text_files({{(path.parent_path() / image).string(), map_to_pgm(grid)},
                    {yaml_path, map_to_yaml(grid, image)}});
}

}  // namespace tagfield
