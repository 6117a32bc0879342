// In C++17, which is the newest that the headers of Debian 11's and Noetic's messages compile with.
#include "adapters/ros1/rfid_publisher.h"

#include <rfid_sensor/TagArray.h>
#include <tagfield_msgs/AntennaTruth.h>
#include <tagfield_msgs/TagPositions.h>
#include <tagfield_msgs/TagReads.h>
#include <tf2_msgs/TFMessage.h>

#include <utility>

#include "adapters/ros1/messages.h"

namespace tagfield {
namespace {

/// A recorder may stand still for some seconds while a simulation runs many times as fast as real
/// time.
constexpr std::uint32_t kQueue = 10'000;
constexpr Duration kLatchInterval = std::chrono::seconds(1);

rfid_sensor::TagArray published_message(const AntennaUpdate& update) {
  rfid_sensor::TagArray message;
  message.header.stamp = to_ros(update.stamp);
  message.header.frame_id = kWorldFrame;
  message.antennaPose = pose_message(update.X_WA);
  message.tags.reserve(update.replies.size());
  for (const TagReply& reply : update.replies) {
    rfid_sensor::Tag tag;
    tag.name = update.tags.labels[reply.slot];
    tag.dist = reply.distance_m;
    tag.phi = reply.phase_rad;
    tag.rssi = reply.rssi_dbm;
    message.tags.push_back(std::move(tag));
  }
  message.ntags = static_cast<std::uint32_t>(message.tags.size());
  return message;
}

tagfield_msgs::TagReads reads_message(const AntennaUpdate& update) {
  tagfield_msgs::TagReads message;
  const AntennaParameters& antenna = update.antenna.parameters;
  message.header.stamp = to_ros(update.stamp);
  message.header.frame_id = update.antenna.frame_id;
  message.antenna = antenna.name;
  message.reads.reserve(update.replies.size());
  for (const TagReply& reply : update.replies) {
    tagfield_msgs::TagRead read;
    read.header.frame_id = message.header.frame_id;
    read.header.stamp = to_ros(reply.stamp);
    read.epc = update.tags.population.id(reply.slot);
    read.reader = antenna.reader;
    read.antenna = antenna.name;
    read.frequency = reply.frequency_hz;
    read.phase = reply.phase_rad;
    read.rssi = reply.rssi_dbm;
    message.reads.push_back(std::move(read));
  }
  return message;
}

tagfield_msgs::AntennaTruth truth_message(const AntennaUpdate& update) {
  tagfield_msgs::AntennaTruth message;
  message.header.stamp = to_ros(update.stamp);
  message.header.frame_id = kWorldFrame;
  message.antenna = update.antenna.parameters.name;
  message.pose = pose_message(update.X_WA);
  for (const TagReply& reply : update.replies) {
    message.epcs.push_back(update.tags.population.id(reply.slot));
    message.distances.push_back(reply.distance_m);
  }
  return message;
}

void add_position(const FieldTags& tags, std::uint32_t slot, tagfield_msgs::TagPositions& message) {
  tagfield_msgs::TagPosition tag;
  tag.epc = tags.population.id(slot);
  tag.position = point_message(tags.population.position(slot));
  message.tags.push_back(std::move(tag));
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
  // ROS names begin with a letter, except behind a slash.
  return name.empty() ? "_" : name;
}

/// Of all tags.
struct RfidPublisher::TagTopics {
  explicit TagTopics(RosLink& link)
      : all(link.advertise<tagfield_msgs::TagPositions>({"", "rfid/truth/tags", kQueue, true})),
        moved(link.advertise<tagfield_msgs::TagPositions>({"", "rfid/truth/tags_moved", kQueue})) {}

  std::shared_ptr<RosPublisher<tagfield_msgs::TagPositions>> all;
  std::shared_ptr<RosPublisher<tagfield_msgs::TagPositions>> moved;
};

/// Of one name space.
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

/// Of one antenna.
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

RfidPublisher::AntennaTopics& RfidPublisher::topics_of(const FieldAntenna& antenna) {
  std::unique_ptr<AntennaTopics>& topics = by_antenna_[antenna.parameters.name];
  if (!topics) {
    topics = std::make_unique<AntennaTopics>();
    topics->data = link_->advertise<rfid_sensor::TagArray>(
        {"~/" + ros_name(antenna.sensor), "data", kQueue, true});
  }
  return *topics;
}

void RfidPublisher::tags_changed(Time stamp, const FieldTags& tags) {
  tagfield_msgs::TagPositions message = empty_positions(stamp);
  tags.population.for_each([&](std::uint32_t slot) { add_position(tags, slot, message); });
  truth_->all->publish(message);
}

void RfidPublisher::tags_moved(Time stamp, const std::vector<std::uint32_t>& slots,
                               const FieldTags& tags) {
  if (!truth_->moved->is_heard()) return;
  tagfield_msgs::TagPositions message = empty_positions(stamp);
  for (const std::uint32_t slot : slots) add_position(tags, slot, message);
  truth_->moved->publish(message);
}

void RfidPublisher::antenna_updated(const AntennaUpdate& update) {
  const FieldAntenna& antenna = update.antenna;
  Topics& topics = topics_in(antenna.name_space);
  if (update.X_PA) {
    tf2_msgs::TFMessage message;
    message.transforms = {
        frame_message(update.stamp, antenna.parent_frame, antenna.frame_id, *update.X_PA)};
    topics.tf->publish(message);
  }
  if (topics.antennas->is_heard()) topics.antennas->publish(truth_message(update));
  if (topics.reads->is_heard()) topics.reads->publish(reads_message(update));
  // Latched, so it is made for those to come too, if not each time.
  AntennaTopics& own = topics_of(antenna);
  const bool stale = update.stamp < own.latched || update.stamp >= own.latched + kLatchInterval;
  if (!stale && !own.data->is_heard()) return;
  own.latched = update.stamp;
  own.data->publish(published_message(update));
}

void RfidPublisher::antenna_added(const FieldAntenna& antenna) {
  topics_in(antenna.name_space);
  topics_of(antenna);
}

void RfidPublisher::antenna_removed(const std::string& antenna) { by_antenna_.erase(antenna); }

}  // namespace tagfield
