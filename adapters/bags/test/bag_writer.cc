// SPDX-License-Identifier: Apache-2.0
#include "adapters/bags/test/bag_writer.h"

#include <nav_msgs/Odometry.h>
#include <rfid_sensor/TagArray.h>
#include <rosbag/bag.h>
#include <tagfield_msgs/AntennaTruth.h>
#include <tagfield_msgs/TagPositions.h>
#include <tagfield_msgs/TagReads.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <limits>

namespace tagfield {

/// A message of any stated type.
struct RawMessage {
  std::string type;
  std::string md5;
  std::vector<std::uint8_t> bytes;
};

}  // namespace tagfield

namespace ros {
namespace message_traits {
template <>
struct DataType<tagfield::RawMessage> {
  static const char* value(const tagfield::RawMessage& message) { return message.type.c_str(); }
};
template <>
struct MD5Sum<tagfield::RawMessage> {
  static const char* value(const tagfield::RawMessage& message) { return message.md5.c_str(); }
};
template <>
struct Definition<tagfield::RawMessage> {
  static const char* value(const tagfield::RawMessage& /*message*/) { return ""; }
};
}  // namespace message_traits
namespace serialization {
template <>
struct Serializer<tagfield::RawMessage> {
  template <typename Stream>
  static void write(Stream& stream, const tagfield::RawMessage& message) {
    const auto size = static_cast<std::uint32_t>(message.bytes.size());
    std::copy(message.bytes.begin(), message.bytes.end(), stream.advance(size));
  }
  static std::uint32_t serializedLength(const tagfield::RawMessage& message) {
    return static_cast<std::uint32_t>(message.bytes.size());
  }
};
}  // namespace serialization
}  // namespace ros

namespace tagfield {
namespace {

ros::Time to_ros(Time stamp) {
  ros::Time time;
  time.fromNSec(static_cast<std::uint64_t>(stamp.time_since_epoch().count()));
  return time;
}

geometry_msgs::Point point_of(const Eigen::Vector3d& p) {
  geometry_msgs::Point point;
  point.x = p.x();
  point.y = p.y();
  point.z = p.z();
  return point;
}

geometry_msgs::Quaternion quaternion_of(const Eigen::Quaterniond& q) {
  geometry_msgs::Quaternion quaternion;
  quaternion.x = q.x();
  quaternion.y = q.y();
  quaternion.z = q.z();
  quaternion.w = q.w();
  return quaternion;
}

geometry_msgs::Pose pose_of(const RigidTransform& X) {
  geometry_msgs::Pose pose;
  pose.position = point_of(X.translation);
  pose.orientation = quaternion_of(X.rotation);
  return pose;
}

std_msgs::Header header_of(Time stamp, const std::string& frame) {
  std_msgs::Header header;
  header.stamp = to_ros(stamp);
  header.frame_id = frame;
  return header;
}

}  // namespace

BagWriter::BagWriter(const std::string& path, const std::string& compression)
    : bag_(std::make_unique<rosbag::Bag>(path, rosbag::bagmode::Write)) {
  if (compression == "bz2") bag_->setCompression(rosbag::compression::BZ2);
  if (compression == "lz4") bag_->setCompression(rosbag::compression::LZ4);
  bag_->setChunkThreshold(4096);
}

BagWriter::~BagWriter() = default;

template <typename Message>
void BagWriter::write(const std::string& topic, Time stamp, const Message& message) {
  // A bag has no time 0.
  const Time received = std::max(receipt == Time::min() ? stamp : receipt, Time(Duration(1)));
  bag_->write(topic, to_ros(received), message);
}

void BagWriter::reads(Time stamp, const std::string& antenna, const std::vector<TagRead>& reads,
                      const std::string& frame) {
  tagfield_msgs::TagReads message;
  message.header = header_of(stamp, frame);
  message.antenna = antenna;
  for (const TagRead& read : reads) {
    tagfield_msgs::TagRead one;
    one.header = header_of(read.stamp, frame);
    one.epc = read.tag;
    one.reader = read.reader;
    one.antenna = read.antenna;
    one.frequency = read.frequency_hz;
    one.phase = read.phase_rad;
    one.rssi = read.rssi_dbm;
    one.doppler = read.doppler_hz.value_or(std::numeric_limits<double>::quiet_NaN());
    message.reads.push_back(one);
  }
  write("/any/reads", stamp, message);
}

void BagWriter::antenna_truth(Time stamp, const std::string& antenna, const RigidTransform& X_WA,
                              const std::map<std::string, double>& distances) {
  tagfield_msgs::AntennaTruth message;
  message.header = header_of(stamp, "world");
  message.antenna = antenna;
  message.pose = pose_of(X_WA);
  for (const auto& [tag, distance] : distances) {
    message.epcs.push_back(tag);
    message.distances.push_back(distance);
  }
  write("/any/truth", stamp, message);
}

void BagWriter::tag_positions(Time stamp, const std::map<std::string, Eigen::Vector3d>& positions) {
  tagfield_msgs::TagPositions message;
  message.header = header_of(stamp, "world");
  for (const auto& [tag, p_WT] : positions) {
    tagfield_msgs::TagPosition one;
    one.epc = tag;
    one.position = point_of(p_WT);
    message.tags.push_back(one);
  }
  write("/any/tags", stamp, message);
}

void BagWriter::robot(const std::string& topic, Time stamp, const RigidTransform& X_WB) {
  nav_msgs::Odometry message;
  message.header = header_of(stamp, "world");
  message.pose.pose = pose_of(X_WB);
  write(topic, stamp, message);
}

void BagWriter::transform(const std::string& topic, Time stamp, const std::string& parent,
                          const std::string& child, const RigidTransform& X_PC) {
  geometry_msgs::TransformStamped transform;
  transform.header = header_of(stamp, parent);
  transform.child_frame_id = child;
  transform.transform.translation.x = X_PC.translation.x();
  transform.transform.translation.y = X_PC.translation.y();
  transform.transform.translation.z = X_PC.translation.z();
  transform.transform.rotation = quaternion_of(X_PC.rotation);
  tf2_msgs::TFMessage message;
  message.transforms.push_back(transform);
  write(topic, stamp, message);
}

void BagWriter::tag_array(const std::string& topic, Time stamp, const RigidTransform& X_WA,
                          const std::vector<ArrayTag>& tags) {
  rfid_sensor::TagArray message;
  message.header = header_of(stamp, "world");
  message.antennaPose = pose_of(X_WA);
  message.ntags = static_cast<std::uint32_t>(tags.size());
  for (const ArrayTag& tag : tags) {
    rfid_sensor::Tag one;
    one.name = tag.name;
    one.dist = tag.distance_m;
    one.phi = tag.phase_rad;
    one.rssi = tag.rssi_dbm;
    message.tags.push_back(one);
  }
  write(topic, stamp, message);
}

void BagWriter::raw(const std::string& topic, const std::string& type, const std::string& md5,
                    const std::vector<std::uint8_t>& bytes) {
  write(topic, Time(Duration(1)), RawMessage{type, md5, bytes});
}

std::string md5_of_tag_reads() { return ros::message_traits::md5sum<tagfield_msgs::TagReads>(); }

}  // namespace tagfield
