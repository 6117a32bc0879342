// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros1/bag_messages.h"

#include <fmt/format.h>
#include <nav_msgs/Odometry.h>
#include <tagfield_msgs/AntennaTruth.h>
#include <tagfield_msgs/TagPositions.h>
#include <tagfield_msgs/TagReads.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "adapters/ros2/ros2_messages.h"
#include "tagfield/base/range_check.h"

namespace tagfield {
namespace {

constexpr double kMaxFrequency = 1e12;      ///< [Hz]
constexpr double kMaxLevel = 1e6;           ///< [dBm]
constexpr std::size_t kLongestName = 1000;  ///< Bytes.
constexpr std::uint32_t kLastSecond = 4'000'000'000;
constexpr Duration kReset = std::chrono::seconds(1);

/// Name of a list's element, formatted for error messages only: "reads[3].epc".
struct FieldName {
  const char* list = "";
  std::size_t index = 0;
  const char* field = "";
};
std::string to_text(const FieldName& name) {
  return fmt::format("{}[{}]{}", name.list, name.index, name.field);
}
const std::string& to_text(const std::string& name) { return name; }

template <class Name>
double checked(double value, double greatest, const Name& what, const MessageLocation& place) {
  if (!(std::abs(value) <= greatest)) {
    fail_at(place, fmt::format("{} is {}, expected a number within ±{:g}", to_text(what), value,
                               greatest));
  }
  return value;
}

template <class Name>
const std::string& checked_name(const std::string& name, const Name& what,
                                const MessageLocation& place) {
  if (name.empty()) fail_at(place, fmt::format("{} is empty, expected a name", to_text(what)));
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20; };
  if (name.size() > kLongestName || std::any_of(name.begin(), name.end(), is_control)) {
    fail_at(place,
            fmt::format("{} is not a valid name: {} bytes{}", to_text(what), name.size(),
                        name.size() > kLongestName ? "" : ", control characters among them"));
  }
  return name;
}

Time stamp_of(const ros2::builtin_interfaces::Time& stamp, const MessageLocation& place) {
  if (stamp.sec < 0) fail_at(place, fmt::format("stamp is {} s, expected 0 or more", stamp.sec));
  if (stamp.nanosec >= 1'000'000'000) {
    fail_at(place, fmt::format("header.stamp is {} s and {} ns, expected a time", stamp.sec,
                               stamp.nanosec));
  }
  return Time(std::chrono::seconds(stamp.sec) + Duration(stamp.nanosec));
}

Time stamp_of(const ros::Time& stamp, const MessageLocation& place) {
  if (stamp.nsec >= 1'000'000'000 || stamp.sec > kLastSecond) {
    fail_at(place,
            fmt::format("header.stamp is {} s and {} ns, expected a time", stamp.sec, stamp.nsec));
  }
  return Time(std::chrono::seconds(stamp.sec) + Duration(stamp.nsec));
}

/// "/map" and "map" are the same frame in tf.
std::string frame_of(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

template <typename Point>  // geometry_msgs' Point or Vector3
Eigen::Vector3d place_of(const Point& p, const std::string& what, const MessageLocation& place) {
  return {checked(p.x, kMaxCoordinate_m, what + ".x", place),
          checked(p.y, kMaxCoordinate_m, what + ".y", place),
          checked(p.z, kMaxCoordinate_m, what + ".z", place)};
}

template <typename Quaternion>
Eigen::Quaterniond rotation_of(const Quaternion& q, const std::string& what,
                               const MessageLocation& place) {
  const Eigen::Quaterniond quaternion(q.w, q.x, q.y, q.z);
  const auto rotation = as_rotation(quaternion);
  if (!rotation) {
    fail_at(place, fmt::format("{} has length {:.3g}, expected 1", what, quaternion.norm()));
  }
  return *rotation;
}

template <typename Pose>
RigidTransform pose_of(const Pose& pose, const std::string& what, const MessageLocation& place) {
  return {rotation_of(pose.orientation, what + ".orientation", place),
          place_of(pose.position, what + ".position", place)};
}

/// Keeps each tag's last position, valid from `stamp` on: its message may have been sent only once.
void keep_last_places(std::vector<TagPosition>& positions, Time stamp) {
  std::map<std::string, TagPosition> last;
  for (const TagPosition& position : positions) last[position.tag] = position;
  positions.clear();
  for (auto& [tag, position] : last) {
    position.stamp = stamp;
    positions.push_back(position);
  }
}

void forget(BagContent& content, Time stamp) {
  content.sink->on_reset();
  BagContent kept(*content.sink);
  kept.truth.tag_positions = std::move(content.truth.tag_positions);
  keep_last_places(kept.truth.tag_positions, stamp);
  for (StampedTransform& transform : content.transforms) {
    if (transform.is_static) kept.transforms.push_back(std::move(transform));
  }
  content = std::move(kept);
}

/// Records the stamp of a stream and detects a reset.
void follow_clock(const std::string& stream, Time stamp, const MessageLocation& place,
                  BagContent& content, Diagnostics& diagnostics) {
  const auto latest = content.clock.find(stream);
  if (latest != content.clock.end() && stamp + kReset < latest->second) {
    diagnostics.warn(fmt::format(
        "{}: time goes back from {} s to {} s (was the simulation reset?); only what comes after "
        "counts",
        to_string(place), format_stamp(latest->second), format_stamp(stamp)));
    forget(content, stamp);
  }
  Time& entry = content.clock[stream];
  entry = std::max(entry, stamp);
}

template <class Message>
TagRead read_of(const Message& message, std::size_t index, const MessageLocation& place) {
  const auto at = [index](const char* field) { return FieldName{"reads", index, field}; };
  TagRead read;
  read.stamp = stamp_of(message.header.stamp, place);
  if (!message.reader.empty()) read.reader = checked_name(message.reader, at(".reader"), place);
  read.antenna = checked_name(message.antenna, at(".antenna"), place);
  read.tag = checked_name(message.epc, at(".epc"), place);
  read.frequency_hz = checked(message.frequency, kMaxFrequency, at(".frequency"), place);
  if (!(read.frequency_hz > 0.0)) {
    fail_at(place, fmt::format("{} is {}, expected more than 0", to_text(at(".frequency")),
                               read.frequency_hz));
  }
  read.phase_rad = checked(message.phase, kMaxLevel, at(".phase"), place);
  read.rssi_dbm = checked(message.rssi, kMaxLevel, at(".rssi"), place);
  if (!std::isnan(message.doppler)) {
    read.doppler_hz = checked(message.doppler, kMaxLevel, at(".doppler"), place);
  }
  return read;
}

/// "/gazebo/antenna/data" → "antenna"
std::string sensor_of(const std::string& topic) {
  const std::size_t last = topic.find_last_of('/');
  if (last == std::string::npos || last == 0) return last_name(topic);
  return last_name(topic.substr(0, last));
}

/// "/p3at/ground_truth/odom" → "p3at"
std::string robot_of(const std::string& topic) {
  const std::size_t end = topic.find("ground_truth/odom");
  std::string name = end == std::string::npos ? topic : topic.substr(0, end);
  while (!name.empty() && name.back() == '/') name.pop_back();
  while (!name.empty() && name.front() == '/') name.erase(0, 1);
  return name.empty() ? "robot" : name;
}

}  // namespace

std::string last_name(const std::string& topic) {
  const std::size_t slash = topic.find_last_of('/');
  return slash == std::string::npos ? topic : topic.substr(slash + 1);
}

template <class TagReads>
void take_reads(const TagReads& message, const MessageLocation& place, BagContent& content,
                Diagnostics& diagnostics) {
  const Time stamp = stamp_of(message.header.stamp, place);
  const std::string antenna = checked_name(message.antenna, "antenna", place);
  const std::string frame = frame_of(message.header.frame_id);
  follow_clock("reads " + antenna, stamp, place, content, diagnostics);
  content.updates.push_back({stamp, antenna, frame});
  for (std::size_t i = 0; i < message.reads.size(); ++i) {
    TagRead read = read_of(message.reads[i], i, place);
    if (read.antenna != antenna) {
      fail_at(place, fmt::format("reads[{}].antenna is '{}', expected '{}' as the message says", i,
                                 read.antenna, antenna));
    }
    content.sink->on_read(std::move(read), frame);
  }
}

template <class AntennaTruth>
void take_antenna_truth(const AntennaTruth& message, const MessageLocation& place,
                        BagContent& content, Diagnostics& diagnostics) {
  const Time stamp = stamp_of(message.header.stamp, place);
  const std::string antenna = checked_name(message.antenna, "antenna", place);
  if (message.epcs.size() != message.distances.size()) {
    fail_at(place, fmt::format("has {} epcs, but {} distances", message.epcs.size(),
                               message.distances.size()));
  }
  const RigidTransform X_WA = pose_of(message.pose, "pose", place);
  follow_clock("truth " + antenna, stamp, place, content, diagnostics);
  content.truth_frame = frame_of(message.header.frame_id);
  content.truth.antenna_poses.push_back({stamp, antenna, X_WA});
  for (std::size_t i = 0; i < message.epcs.size(); ++i) {
    content.sink->on_distance(
        {stamp, antenna, checked_name(message.epcs[i], FieldName{"epcs", i}, place),
         checked(message.distances[i], kMaxCoordinate_m, FieldName{"distances", i}, place)});
  }
}

template <class TagPositions>
void take_tag_positions(const TagPositions& message, const MessageLocation& place,
                        BagContent& content, Diagnostics& /*diagnostics*/) {
  const Time stamp = stamp_of(message.header.stamp, place);
  for (std::size_t i = 0; i < message.tags.size(); ++i) {
    const std::string at = fmt::format("tags[{}].", i);
    content.truth.tag_positions.push_back(
        {stamp, checked_name(message.tags[i].epc, at + "epc", place),
         place_of(message.tags[i].position, at + "position", place)});
  }
}

template <class Odometry>
void take_odometry(const Odometry& message, const MessageLocation& place, BagContent& content,
                   Diagnostics& diagnostics) {
  const Time stamp = stamp_of(message.header.stamp, place);
  const std::string robot = checked_name(robot_of(place.topic), "the topic's namespace", place);
  const RigidTransform X_WB = pose_of(message.pose.pose, "pose.pose", place);
  follow_clock("robot " + robot, stamp, place, content, diagnostics);
  content.truth.robot_poses.push_back({stamp, robot, X_WB});
}

template <class TFMessage>
void take_transforms(const TFMessage& message, const MessageLocation& place, BagContent& content,
                     Diagnostics& diagnostics) {
  const bool is_static = last_name(place.topic) == "tf_static";
  for (std::size_t i = 0; i < message.transforms.size(); ++i) {
    const auto& transform = message.transforms[i];
    const std::string at = fmt::format("transforms[{}].", i);
    StampedTransform taken;
    taken.stamp = stamp_of(transform.header.stamp, place);
    taken.parent = checked_name(frame_of(transform.header.frame_id), at + "header.frame_id", place);
    taken.child = checked_name(frame_of(transform.child_frame_id), at + "child_frame_id", place);
    if (taken.parent == taken.child) {
      fail_at(place, fmt::format("{}child_frame_id is '{}' as its parent", at, taken.child));
    }
    taken.X_PC = {rotation_of(transform.transform.rotation, at + "rotation", place),
                  place_of(transform.transform.translation, at + "translation", place)};
    taken.is_static = is_static;
    if (!is_static) follow_clock("tf " + taken.child, taken.stamp, place, content, diagnostics);
    content.transforms.push_back(std::move(taken));
  }
}

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

template void take_reads(const tagfield_msgs::TagReads&, const MessageLocation&, BagContent&,
                         Diagnostics&);
template void take_reads(const ros2::tagfield_msgs::TagReads&, const MessageLocation&, BagContent&,
                         Diagnostics&);
template void take_antenna_truth(const tagfield_msgs::AntennaTruth&, const MessageLocation&,
                                 BagContent&, Diagnostics&);
template void take_antenna_truth(const ros2::tagfield_msgs::AntennaTruth&, const MessageLocation&,
                                 BagContent&, Diagnostics&);
template void take_tag_positions(const tagfield_msgs::TagPositions&, const MessageLocation&,
                                 BagContent&, Diagnostics&);
template void take_tag_positions(const ros2::tagfield_msgs::TagPositions&, const MessageLocation&,
                                 BagContent&, Diagnostics&);
template void take_odometry(const nav_msgs::Odometry&, const MessageLocation&, BagContent&,
                            Diagnostics&);
template void take_odometry(const ros2::nav_msgs::Odometry&, const MessageLocation&, BagContent&,
                            Diagnostics&);
template void take_transforms(const tf2_msgs::TFMessage&, const MessageLocation&, BagContent&,
                              Diagnostics&);
template void take_transforms(const ros2::tf2_msgs::TFMessage&, const MessageLocation&, BagContent&,
                              Diagnostics&);

}  // namespace tagfield
