// SPDX-License-Identifier: Apache-2.0
#include "adapters/bags/bag_messages.h"

#include <utility>

#include "adapters/bags/message_fields.h"

namespace tagfield::recorded {
namespace {

/// "/gazebo/antenna/data" → "antenna"
std::string sensor_of(const std::string& topic) {
  const std::size_t last = topic.find_last_of('/');
  if (last == std::string::npos || last == 0) return last_name(topic);
  return last_name(topic.substr(0, last));
}

}  // namespace

void take_array(const rfid_sensor::TagArray& message, const MessageLocation& place,
                double frequency_hz, BagContent& content, Diagnostics& diagnostics) {
  const Time stamp = stamp_of(message.header.stamp, place);
  const std::string antenna = checked_name(sensor_of(place.topic), "the topic's sensor", place);
  const geometry_msgs::Quaternion& q = message.antennaPose.orientation;
  RigidTransform X_WA;
  X_WA.translation = place_of(message.antennaPose.position, "antennaPose.position", place);
  // A message with only a position leaves all four at 0.
  if (q.x != 0.0 || q.y != 0.0 || q.z != 0.0 || q.w != 0.0) {
    X_WA.rotation = rotation_of(q, "antennaPose.orientation", place);
  }
  follow_clock("array " + antenna, stamp, place, content, diagnostics);
  content.truth_frame = frame_of(message.header.frame_id);
  content.given_poses.push_back({stamp, antenna, X_WA});
  content.updates.push_back({stamp, antenna, ""});
  for (std::size_t i = 0; i < message.tags.size(); ++i) {
    const rfid_sensor::Tag& tag = message.tags[i];
    const std::string at = fmt::format("tags[{}].", i);
    TagRead read = {stamp,
                    "",
                    antenna,
                    checked_name(tag.name, at + "name", place),
                    frequency_hz,
                    checked(tag.phi, kMaxLevel, at + "phi", place),
                    checked(tag.rssi, kMaxLevel, at + "rssi", place)};
    content.sink->on_distance(
        {stamp, antenna, read.tag, checked(tag.dist, kMaxCoordinate_m, at + "dist", place)});
    content.sink->on_read(std::move(read), "");
  }
}

}  // namespace tagfield::recorded
