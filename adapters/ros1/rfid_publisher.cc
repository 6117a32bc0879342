// SPDX-License-Identifier: Apache-2.0
// In C++17, which is the newest that the headers of Debian 11's and Noetic's messages compile with.
#include "adapters/ros1/rfid_publisher.h"

#include <rfid_sensor/TagArray.h>
#include <tagfield_msgs/AntennaTruth.h>
#include <tagfield_msgs/TagPositions.h>
#include <tagfield_msgs/TagReads.h>
#include <tf2_msgs/TFMessage.h>

#include <limits>
#include <utility>

#include "adapters/ros1/messages.h"

namespace tagfield {
namespace {

/// A recorder may stall for some seconds while a simulation runs many times faster than real time.
constexpr std::uint32_t kQueue = 10'000;
constexpr Duration kLatchInterval = std::chrono::seconds(1);

tagfield_msgs::TagRead read_message(const TagRead& read, const std::string& frame_id) {
  tagfield_msgs::TagRead message;
  message.header.frame_id = frame_id;
  message.header.stamp = to_ros(read.stamp);
  message.epc = read.tag;
  message.reader = read.reader;
  message.antenna = read.antenna;
  message.frequency = read.frequency_hz;
  message.phase = read.phase_rad;
  message.rssi = read.rssi_dbm;
  message.doppler = read.doppler_hz.value_or(std::numeric_limits<double>::quiet_NaN());
  return message;
}

tagfield_msgs::TagReads reads_message(const AntennaInfo& antenna, Time stamp,
                                      const std::vector<TagRead>& reads) {
  tagfield_msgs::TagReads message;
  message.header.stamp = to_ros(stamp);
  message.header.frame_id = antenna.frame_id;
  message.antenna = antenna.name;
  message.reads.reserve(reads.size());
  for (const TagRead& read : reads) message.reads.push_back(read_message(read, antenna.frame_id));
  return message;
}

tagfield_msgs::AntennaTruth truth_message(const AntennaInfo& antenna, Time stamp,
                                          const RigidTransform& X_WA,
                                          const std::vector<TagRead>& reads,
                                          const std::vector<double>& distances_m) {
  tagfield_msgs::AntennaTruth message;
  message.header.stamp = to_ros(stamp);
  message.header.frame_id = kWorldFrame;
  message.antenna = antenna.name;
  message.pose = pose_message(X_WA);
  for (const TagRead& read : reads) message.epcs.push_back(read.tag);
  message.distances = distances_m;
  return message;
}

tagfield_msgs::TagPosition position_message(const TagPosition& tag) {
  tagfield_msgs::TagPosition message;
  message.epc = tag.tag;
  message.position = point_message(tag.p_WT);
  return message;
}

tagfield_msgs::TagPositions empty_positions(Time stamp) {
  tagfield_msgs::TagPositions message;
  message.header.stamp = to_ros(stamp);
  message.header.frame_id = kWorldFrame;
  return message;
}

}  // namespace

std::string ros_name(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool allowed =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    name += allowed ? c : '_';
  }
  // ROS names begin with a letter, except after a slash.
  return name.empty() ? "_" : name;
}

/// Topics of all tags.
struct RfidPublisher::TagTopics {
  explicit TagTopics(RosLink& link)
      : all(link.advertise<tagfield_msgs::TagPositions>({"", "rfid/truth/tags", kQueue, true})),
        moved(link.advertise<tagfield_msgs::TagPositions>({"", "rfid/truth/tags_moved", kQueue})) {}

  std::shared_ptr<RosPublisher<tagfield_msgs::TagPositions>> all;
  std::shared_ptr<RosPublisher<tagfield_msgs::TagPositions>> moved;
};

/// Topics of one namespace.
struct RfidPublisher::Topics {
  Topics(RosLink& link, const std::string& name_space)
      : reads(link.advertise<tagfield_msgs::TagReads>({name_space, "rfid/reads", kQueue})),
        antennas(link.advertise<tagfield_msgs::AntennaTruth>(
            {name_space, "rfid/truth/antennas", kQueue})),
        tf(link.advertise<tf2_msgs::TFMessage>({name_space, "/tf", kQueue})) {}

  std::shared_ptr<RosPublisher<tagfield_msgs::TagReads>> reads;
  std::shared_ptr<RosPublisher<tagfield_msgs::AntennaTruth>> antennas;
  std::shared_ptr<RosPublisher<tf2_msgs::TFMessage>> tf;
};

/// Topics of one antenna.
struct RfidPublisher::AntennaTopics {
  std::shared_ptr<RosPublisher<rfid_sensor::TagArray>> data;
  Time latched = Time(-kLatchInterval);  ///< Stamp of the last message.
};

RfidPublisher::RfidPublisher(std::shared_ptr<RosLink> link)
    : link_(std::move(link)), truth_(std::make_unique<TagTopics>(*link_)) {}

RfidPublisher::~RfidPublisher() = default;

RfidPublisher::Topics& RfidPublisher::topics_in(const std::string& name_space) {
  std::unique_ptr<Topics>& topics = by_name_space_[name_space];
  if (!topics) topics = std::make_unique<Topics>(*link_, name_space);
  return *topics;
}

RfidPublisher::AntennaTopics& RfidPublisher::topics_of(const AntennaInfo& antenna) {
  std::unique_ptr<AntennaTopics>& topics = by_antenna_[antenna.name];
  if (!topics) {
    topics = std::make_unique<AntennaTopics>();
    topics->data = link_->advertise<rfid_sensor::TagArray>(
        {"~/" + ros_name(antenna.sensor), "data", kQueue, true});
  }
  return *topics;
}

void RfidPublisher::on_tag_added(const TagPosition& tag, const std::string& label) {
  tags_[tag.tag] = {label, tag};
  has_changed_ = true;
}

void RfidPublisher::on_tag_removed(const std::string& id) {
  tags_.erase(id);
  has_changed_ = true;
}

void RfidPublisher::on_tag_moved(const TagPosition& tag) {
  tags_[tag.tag].position = tag;
  moved_.push_back(tag.tag);
}

void RfidPublisher::on_tags_placed(Time stamp) {
  if (std::exchange(has_changed_, false)) {
    tagfield_msgs::TagPositions message = empty_positions(stamp);
    for (const auto& [id, tag] : tags_) message.tags.push_back(position_message(tag.position));
    truth_->all->publish(message);
  }
  const std::vector<std::string> moved = std::exchange(moved_, {});
  if (moved.empty() || !truth_->moved->is_heard()) return;
  tagfield_msgs::TagPositions message = empty_positions(stamp);
  for (const std::string& id : moved) message.tags.push_back(position_message(tags_[id].position));
  truth_->moved->publish(message);
}

void RfidPublisher::on_pose(const AntennaInfo& antenna, const AntennaPose& pose) {
  tf2_msgs::TFMessage message;
  message.transforms = {
      frame_message(pose.stamp, antenna.parent_frame, antenna.frame_id, pose.X_WA)};
  topics_in(antenna.name_space).tf->publish(message);
}

void RfidPublisher::on_antenna_pose(const AntennaInfo& antenna, const AntennaPose& pose) {
  updates_[antenna.name].X_WA = pose.X_WA;
}

void RfidPublisher::on_distance(const TrueDistance& distance) {
  updates_[distance.antenna].distances_m.push_back(distance.distance_m);
}

void RfidPublisher::on_read(const TagRead& read) { updates_[read.antenna].reads.push_back(read); }

void RfidPublisher::publish_in_old_form(const AntennaInfo& antenna, Time stamp,
                                        const Update& update) {
  rfid_sensor::TagArray message;
  message.header.stamp = to_ros(stamp);
  message.header.frame_id = kWorldFrame;
  message.antennaPose = pose_message(update.X_WA);
  for (std::size_t i = 0; i < update.reads.size(); ++i) {
    const TagRead& read = update.reads[i];
    rfid_sensor::Tag tag;
    tag.name = tags_[read.tag].label;
    tag.dist = update.distances_m[i];
    tag.phi = read.phase_rad;
    tag.rssi = read.rssi_dbm;
    message.tags.push_back(std::move(tag));
  }
  message.ntags = static_cast<std::uint32_t>(message.tags.size());
  topics_of(antenna).data->publish(message);
}

void RfidPublisher::on_update(const AntennaInfo& antenna, Time stamp) {
  const Update update = std::exchange(updates_[antenna.name], {});
  const Topics& topics = topics_in(antenna.name_space);
  if (topics.antennas->is_heard()) {
    topics.antennas->publish(
        truth_message(antenna, stamp, update.X_WA, update.reads, update.distances_m));
  }
  if (topics.reads->is_heard()) {
    topics.reads->publish(reads_message(antenna, stamp, update.reads));
  }
  // Latched, so it is also generated for late subscribers, though not in each update.
  AntennaTopics& own = topics_of(antenna);
  const bool stale = stamp < own.latched || stamp >= own.latched + kLatchInterval;
  if (!stale && !own.data->is_heard()) return;
  own.latched = stamp;
  publish_in_old_form(antenna, stamp, update);
}

void RfidPublisher::on_antenna_added(const AntennaInfo& antenna) {
  topics_in(antenna.name_space);
  topics_of(antenna);
}

void RfidPublisher::on_antenna_removed(const std::string& name) {
  by_antenna_.erase(name);
  updates_.erase(name);
}

}  // namespace tagfield
