// SPDX-License-Identifier: Apache-2.0
#include "adapters/bags/bag_wire.h"

#include <fmt/format.h>
#include <nav_msgs/Odometry.h>
#include <rfid_sensor/TagArray.h>
#include <ros/serialization.h>
#include <tagfield_msgs/AntennaTruth.h>
#include <tagfield_msgs/TagPositions.h>
#include <tagfield_msgs/TagReads.h>
#include <tf2_msgs/TFMessage.h>

#include "tagfield/base/error.h"

namespace tagfield {
namespace {

using ros::serialization::IStream;

/// Reads a list in ROS' encoding. ROS' own reader allocates as many elements as the count states,
/// even 4 GB, before it checks that they exist. Each element takes at least `min_bytes`.
template <typename Element>
void read_list(IStream& stream, std::vector<Element>& list, std::uint32_t min_bytes) {
  std::uint32_t count = 0;
  stream.next(count);
  if (count > stream.getLength() / min_bytes) {
    throw Error(fmt::format("has a list of {} elements, but only {} bytes are left", count,
                            stream.getLength()));
  }
  list.resize(count);
  for (Element& element : list) stream.next(element);
}

// Minimum size of each kind of element: empty strings, and all numbers.
constexpr std::uint32_t kText = 4;
constexpr std::uint32_t kNumber = 8;
constexpr std::uint32_t kHeader = 12 + kText;
constexpr std::uint32_t kTagRead = kHeader + 3 * kText + 3 * kNumber;
constexpr std::uint32_t kTagPosition = kText + 3 * kNumber;
constexpr std::uint32_t kTransform = kHeader + kText + 7 * kNumber;
constexpr std::uint32_t kTag = kText + 3 * kNumber;

void read_fields(IStream& stream, tagfield_msgs::TagReads& message) {
  stream.next(message.header);
  stream.next(message.antenna);
  read_list(stream, message.reads, kTagRead);
}

void read_fields(IStream& stream, tagfield_msgs::AntennaTruth& message) {
  stream.next(message.header);
  stream.next(message.antenna);
  stream.next(message.pose);
  read_list(stream, message.epcs, kText);
  read_list(stream, message.distances, kNumber);
}

void read_fields(IStream& stream, tagfield_msgs::TagPositions& message) {
  stream.next(message.header);
  read_list(stream, message.tags, kTagPosition);
}

void read_fields(IStream& stream, rfid_sensor::TagArray& message) {
  stream.next(message.header);
  stream.next(message.antennaPose);
  stream.next(message.ntags);
  read_list(stream, message.tags, kTag);
}

void read_fields(IStream& stream, tf2_msgs::TFMessage& message) {
  read_list(stream, message.transforms, kTransform);
}

void read_fields(IStream& stream, nav_msgs::Odometry& message) { stream.next(message); }

}  // namespace

template <typename M>
M decode(std::vector<std::uint8_t>& bytes, const MessageLocation& place) {
  M message;
  IStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  try {
    read_fields(stream, message);
  } catch (const Error& error) {
    fail_at(place, error.what());
  } catch (const ros::serialization::StreamOverrunException&) {
    fail_at(place,
            fmt::format("ends too early: its {} bytes are not a whole message", bytes.size()));
  }
  if (stream.getLength() != 0) {
    fail_at(place, fmt::format("is {} bytes longer than its type", stream.getLength()));
  }
  return message;
}

template tagfield_msgs::TagReads decode(std::vector<std::uint8_t>&, const MessageLocation&);
template tagfield_msgs::AntennaTruth decode(std::vector<std::uint8_t>&, const MessageLocation&);
template tagfield_msgs::TagPositions decode(std::vector<std::uint8_t>&, const MessageLocation&);
template rfid_sensor::TagArray decode(std::vector<std::uint8_t>&, const MessageLocation&);
template nav_msgs::Odometry decode(std::vector<std::uint8_t>&, const MessageLocation&);
template tf2_msgs::TFMessage decode(std::vector<std::uint8_t>&, const MessageLocation&);

}  // namespace tagfield
