// SPDX-License-Identifier: Apache-2.0
// In C++17, which is the newest that the headers of Debian 11's and Noetic's messages compile with.
#include "adapters/ros1/rfid_markers.h"

#include <visualization_msgs/MarkerArray.h>

#include <utility>

#include "adapters/ros1/messages.h"
#include "adapters/ros1/rfid_publisher.h"

namespace tagfield {
namespace {

using visualization_msgs::Marker;

constexpr Duration kInterval = std::chrono::milliseconds(500);
constexpr double kTagEdge = 0.1;      // [m] larger than a label, to be visible across a hall
constexpr double kArrowLength = 0.5;  // [m]
constexpr double kArrowWidth = 0.08;  // [m]

std_msgs::ColorRGBA color_message(const ReadColor& color) {
  std_msgs::ColorRGBA message;
  message.r = static_cast<float>(color.red);
  message.g = static_cast<float>(color.green);
  message.b = static_cast<float>(color.blue);
  message.a = static_cast<float>(color.alpha);
  return message;
}

Marker marker_of(Time stamp, const std::string& name_space, int id, int type) {
  Marker marker;
  marker.header.stamp = to_ros(stamp);
  marker.header.frame_id = kWorldFrame;
  marker.ns = name_space;
  marker.id = id;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1.0;
  return marker;
}

Marker arrow_of(Time stamp, int id, const SeenAntenna& antenna) {
  Marker marker = marker_of(stamp, "antennas", id, Marker::ARROW);
  marker.pose = pose_message(antenna.X_WA);
  marker.scale.x = kArrowLength;
  marker.scale.y = marker.scale.z = kArrowWidth;
  marker.color = color_message({0.9, 0.55, 0.0, 1.0});
  return marker;
}

Marker ball_of(Time stamp, int id, const SeenAntenna& antenna) {
  Marker marker = marker_of(stamp, "ranges", id, Marker::SPHERE);
  marker.pose.position = point_message(antenna.X_WA.translation);
  marker.scale.x = marker.scale.y = marker.scale.z = 2.0 * antenna.range_m;
  marker.color = color_message({0.9, 0.7, 0.2, 0.08});
  return marker;
}

Marker clear_all(Time stamp) {
  Marker marker = marker_of(stamp, "", 0, 0);
  marker.action = Marker::DELETEALL;
  return marker;
}

}  // namespace

struct RfidMarkers::Topic {
  std::shared_ptr<RosPublisher<visualization_msgs::MarkerArray>> markers;
};

RfidMarkers::RfidMarkers(std::shared_ptr<RosLink> link)
    : FieldPicture(kInterval), link_(std::move(link)), topic_(std::make_unique<Topic>()) {
  topic_->markers = link_->advertise<visualization_msgs::MarkerArray>({"", "rfid/markers", 10});
}

RfidMarkers::~RfidMarkers() = default;

void RfidMarkers::draw(Time stamp) {
  if (!topic_->markers->is_heard()) return;
  visualization_msgs::MarkerArray message;
  std::set<std::string> present;
  for (const auto& [name, antenna] : antennas()) present.insert(name);
  if (present != drawn_antennas_) message.markers.push_back(clear_all(stamp));
  drawn_antennas_ = std::move(present);

  Marker cubes = marker_of(stamp, "tags", 0, Marker::CUBE_LIST);
  cubes.scale.x = cubes.scale.y = cubes.scale.z = kTagEdge;
  for (const auto& [id, tag] : tags()) {
    cubes.points.push_back(point_message(tag.p_WT));
    cubes.colors.push_back(color_message(color_of(tag, stamp)));
  }
  if (cubes.points.empty()) cubes.action = Marker::DELETE;
  message.markers.push_back(std::move(cubes));
  int number = 0;
  for (const auto& [name, antenna] : antennas()) {
    message.markers.push_back(arrow_of(stamp, number, antenna));
    message.markers.push_back(ball_of(stamp, number, antenna));
    ++number;
  }
  topic_->markers->publish(message);
}

}  // namespace tagfield
