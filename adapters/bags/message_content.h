// SPDX-License-Identifier: Apache-2.0
/// @file
/// Conversion of recorded messages of tagfield_msgs, nav_msgs and tf2_msgs, of ROS 1 or ROS 2, to
/// BagContent. Throw Error as the checks of message_fields.h.
#pragma once

#include <string>
#include <utility>

#include "adapters/bags/bag_content.h"
#include "adapters/bags/message_fields.h"

namespace tagfield::recorded {

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

/// The robot's name is the topic's namespace, or "robot" if there is none.
template <class Odometry>
void take_odometry(const Odometry& message, const MessageLocation& place, BagContent& content,
                   Diagnostics& diagnostics) {
  const Time stamp = stamp_of(message.header.stamp, place);
  const std::string robot = checked_name(robot_of(place.topic), "the topic's namespace", place);
  const RigidTransform X_WB = pose_of(message.pose.pose, "pose.pose", place);
  follow_clock("robot " + robot, stamp, place, content, diagnostics);
  content.truth.robot_poses.push_back({stamp, robot, X_WB});
}

/// Transforms of a topic "…/tf_static" are static.
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

}  // namespace tagfield::recorded
