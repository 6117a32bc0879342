// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros1/bag_messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "tagfield/base/range_check.h"

namespace tagfield {
namespace {

constexpr double kGreatestFrequency = 1e12;  ///< [Hz]
constexpr double kGreatestLevel = 1e6;       ///< [dBm]
constexpr std::size_t kLongestName = 1000;   ///< Bytes.
constexpr std::uint32_t kLastSecond = 4'000'000'000;
constexpr Duration kReset = std::chrono::seconds(1);

double checked(double value, double greatest, const std::string& what, const MessagePlace& place) {
  if (!(std::abs(value) <= greatest)) {
    fail_at(place, fmt::format("{} is {}, expected a number within ±{:g}", what, value, greatest));
  }
  return value;
}

std::string checked_name(const std::string& name, const std::string& what,
                         const MessagePlace& place) {
  if (name.empty()) fail_at(place, what + " is empty, expected a name");
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20; };
  if (name.size() > kLongestName || std::any_of(name.begin(), name.end(), is_control)) {
    fail_at(place,
            fmt::format("{} is no name: {} bytes{}", what, name.size(),
                        name.size() > kLongestName ? "" : ", control characters among them"));
  }
  return name;
}

Time stamp_of(const ros::Time& stamp, const MessagePlace& place) {
  if (stamp.nsec >= 1'000'000'000 || stamp.sec > kLastSecond) {
    fail_at(place,
            fmt::format("header.stamp is {} s and {} ns, expected a time", stamp.sec, stamp.nsec));
  }
  return Time(std::chrono::seconds(stamp.sec) + Duration(stamp.nsec));
}

/// tf knows "/map" and "map" as the same.
std::string frame_of(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

template <typename Point>  // geometry_msgs' Point or Vector3
Eigen::Vector3d place_of(const Point& p, const std::string& what, const MessagePlace& place) {
  return {checked(p.x, kMostCoordinate_m, what + ".x", place),
          checked(p.y, kMostCoordinate_m, what + ".y", place),
          checked(p.z, kMostCoordinate_m, what + ".z", place)};
}

Eigen::Quaterniond rotation_of(const geometry_msgs::Quaternion& q, const std::string& what,
                               const MessagePlace& place) {
  const Eigen::Quaterniond quaternion(q.w, q.x, q.y, q.z);
  const auto rotation = as_rotation(quaternion);
  if (!rotation) {
    fail_at(place, fmt::format("{} has length {:.3g}, expected 1", what, quaternion.norm()));
  }
  return *rotation;
}

RigidTransform pose_of(const geometry_msgs::Pose& pose, const std::string& what,
                       const MessagePlace& place) {
  return {rotation_of(pose.orientation, what + ".orientation", place),
          place_of(pose.position, what + ".position", place)};
}

/// Keeps of each tag where it was last, from `stamp` on: its message may have been sent once only.
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
  BagContent kept;
  kept.truth.tag_positions = std::move(content.truth.tag_positions);
  keep_last_places(kept.truth.tag_positions, stamp);
  for (StampedTransform& transform : content.transforms) {
    if (transform.is_static) kept.transforms.push_back(std::move(transform));
  }
  content = std::move(kept);
}

/// Notes the stamp of a stream and notices a reset.
void follow_clock(const std::string& stream, Time stamp, const MessagePlace& place,
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

TagRead read_of(const tagfield_msgs::TagRead& message, std::size_t index,
                const MessagePlace& place) {
  const std::string at = fmt::format("reads[{}].", index);
  TagRead read;
  read.stamp = stamp_of(message.header.stamp, place);
  if (!message.reader.empty()) read.reader = checked_name(message.reader, at + "reader", place);
  read.antenna = checked_name(message.antenna, at + "antenna", place);
  read.tag = checked_name(message.epc, at + "epc", place);
  read.frequency_hz = checked(message.frequency, kGreatestFrequency, at + "frequency", place);
  if (!(read.frequency_hz > 0.0)) {
    fail_at(place, fmt::format("{}frequency is {}, expected more than 0", at, read.frequency_hz));
  }
  read.phase_rad = checked(message.phase, kGreatestLevel, at + "phase", place);
  read.rssi_dbm = checked(message.rssi, kGreatestLevel, at + "rssi", place);
  if (!std::isnan(message.doppler)) {
    read.doppler_hz = checked(message.doppler, kGreatestLevel, at + "doppler", place);
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

void take(const tagfield_msgs::TagReads& message, const MessagePlace& place, BagContent& content,
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
    if (read.stamp != content.updates.back().stamp) {
      content.updates.push_back({read.stamp, antenna, frame});
    }
    content.reads.push_back(std::move(read));
  }
}

void take(const tagfield_msgs::AntennaTruth& message, const MessagePlace& place,
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
    content.truth.distances.push_back(
        {stamp, antenna, checked_name(message.epcs[i], fmt::format("epcs[{}]", i), place),
         checked(message.distances[i], kMostCoordinate_m, fmt::format("distances[{}]", i), place)});
  }
}

void take(const tagfield_msgs::TagPositions& message, const MessagePlace& place,
          BagContent& content, Diagnostics& /*diagnostics*/) {
  const Time stamp = stamp_of(message.header.stamp, place);
  for (std::size_t i = 0; i < message.tags.size(); ++i) {
    const std::string at = fmt::format("tags[{}].", i);
    content.truth.tag_positions.push_back(
        {stamp, checked_name(message.tags[i].epc, at + "epc", place),
         place_of(message.tags[i].position, at + "position", place)});
  }
}

void take(const nav_msgs::Odometry& message, const MessagePlace& place, BagContent& content,
          Diagnostics& diagnostics) {
  const Time stamp = stamp_of(message.header.stamp, place);
  const std::string robot = checked_name(robot_of(place.topic), "the topic's namespace", place);
  const RigidTransform X_WB = pose_of(message.pose.pose, "pose.pose", place);
  follow_clock("robot " + robot, stamp, place, content, diagnostics);
  content.truth.robot_poses.push_back({stamp, robot, X_WB});
}

void take(const tf2_msgs::TFMessage& message, const MessagePlace& place, BagContent& content,
          Diagnostics& diagnostics) {
  const bool is_static = last_name(place.topic) == "tf_static";
  for (std::size_t i = 0; i < message.transforms.size(); ++i) {
    const geometry_msgs::TransformStamped& transform = message.transforms[i];
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

void take(const rfid_sensor::TagArray& message, const MessagePlace& place, double frequency_hz,
          BagContent& content, Diagnostics& diagnostics) {
  const Time stamp = stamp_of(message.header.stamp, place);
  const std::string antenna = checked_name(sensor_of(place.topic), "the topic's sensor", place);
  const geometry_msgs::Quaternion& q = message.antennaPose.orientation;
  RigidTransform X_WA;
  X_WA.translation = place_of(message.antennaPose.position, "antennaPose.position", place);
  // A message that only gives the place leaves all four at 0.
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
                    checked(tag.phi, kGreatestLevel, at + "phi", place),
                    checked(tag.rssi, kGreatestLevel, at + "rssi", place)};
    content.truth.distances.push_back(
        {stamp, antenna, read.tag, checked(tag.dist, kMostCoordinate_m, at + "dist", place)});
    content.reads.push_back(std::move(read));
  }
}

}  // namespace tagfield
