// In C++17, which is the newest that the headers of Debian's and Noetic's messages compile with.
#include "adapters/ros1/navigation/map_keeper.h"

#include <filesystem>

#include "adapters/ros1/navigation/navigation_messages.h"
#include "tagfield/map/map_file.h"
#include "tagfield/stream/files.h"

namespace tagfield {

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

void write_map(const OccupancyGrid& grid, const std::string& yaml_path) {
  const std::filesystem::path path(yaml_path);
  const std::string image = path.stem().string() + ".pgm";
  StagedFolder folder(path.has_parent_path() ? path.parent_path() : ".");
  folder.add(image, map_to_pgm(grid));
  folder.add(path.filename(), map_to_yaml(grid, image));
  folder.commit();
}

}  // namespace tagfield
