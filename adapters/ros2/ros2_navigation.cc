// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/ros2_navigation.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "adapters/ros2/internal/to_message.h"

namespace tagfield::ros2 {
namespace {

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
  message.range_min = static_cast<float>(scan.min_range_m);
  message.range_max = static_cast<float>(scan.max_range_m);
  message.ranges.reserve(scan.ranges_m.size());
  for (const float range_m : scan.ranges_m) message.ranges.push_back(range_of(scan, range_m));
  return message;
}

nav_msgs::OccupancyGrid grid_message(const OccupancyGrid& grid) {
  nav_msgs::OccupancyGrid message;
  message.header = header_message({}, kMapFrame);
  message.info.resolution = static_cast<float>(grid.resolution_m);
  message.info.width = static_cast<std::uint32_t>(grid.width);
  message.info.height = static_cast<std::uint32_t>(grid.height);
  message.info.origin = pose_message(from_translation({grid.origin.x(), grid.origin.y(), 0.0}));
  message.data = grid.cells;
  return message;
}

Ros2Navigation::Ros2Navigation(std::shared_ptr<MessageSink> sink,
                               std::shared_ptr<Ros2Outlet> outlet, const LaserParameters& laser)
    : sink_(std::move(sink)),
      outlet_(std::move(outlet)),
      laser_(laser),
      map_(*sink_, {"/map", Delivery::kLatched}) {}

void Ros2Navigation::on_map(const OccupancyGrid& map) { map_.publish({}, grid_message(map)); }

const Ros2Navigation::Scans& Ros2Navigation::scans_of(const std::string& robot) {
  const auto found = scans_.find(robot);
  if (found != scans_.end()) return found->second;
  outlet_->tell_fixed_frame({},
                            frame_message({}, robot + "/base_link", robot + "/laser", laser_.X_RL));
  const Ros2Topic topic{fmt::format("/{}/scan", topic_token(robot)), Delivery::kBestEffort};
  return scans_.emplace(robot, Scans(*sink_, topic)).first->second;
}

void Ros2Navigation::on_scan(const std::string& robot, const PlanarPose& pose_M,
                             const LaserScan& scan) {
  const Scans& scans = scans_of(robot);
  outlet_->tell_time(scan.stamp);  // Scans may be more frequent than updates.
  outlet_->tell_frame(
      scan.stamp, frame_message(scan.stamp, kMapFrame, robot + "/base_link", to_transform(pose_M)));
  scans.publish(scan.stamp, scan_message(scan, robot + "/laser", laser_.rate_hz));
}

}  // namespace tagfield::ros2
