// SPDX-License-Identifier: Apache-2.0
#include "adapters/gz/transport_publisher.h"

#include <tagfield/msgs/truth.pb.h>

#include <chrono>
#include <utility>

#include "adapters/gazebo_common/gz_names.h"

namespace tagfield {
namespace {

constexpr Duration kTagsInterval = std::chrono::seconds(1);

void set_time(Time stamp, msgs::Time& to) {
  const Duration since = stamp.time_since_epoch();
  const auto seconds = std::chrono::floor<std::chrono::seconds>(since);
  to.set_sec(seconds.count());
  to.set_nsec(static_cast<std::int32_t>((since - seconds).count()));
}

void set_vector(const Eigen::Vector3d& p, msgs::Vector3& to) {
  to.set_x(p.x());
  to.set_y(p.y());
  to.set_z(p.z());
}

void set_read(const TagRead& read, msgs::TagRead& to) {
  set_time(read.stamp, *to.mutable_stamp());
  to.set_epc(read.tag);
  to.set_reader(read.reader);
  to.set_antenna(read.antenna);
  to.set_frequency_hz(read.frequency_hz);
  to.set_phase_rad(read.phase_rad);
  to.set_rssi_dbm(read.rssi_dbm);
  if (read.doppler_hz) to.set_doppler_hz(*read.doppler_hz);
}

msgs::TagReads reads_message(const AntennaInfo& antenna, Time stamp,
                             const std::vector<TagRead>& reads) {
  msgs::TagReads message;
  set_time(stamp, *message.mutable_stamp());
  message.set_frame_id(antenna.frame_id);
  message.set_antenna(antenna.name);
  for (const TagRead& read : reads) set_read(read, *message.add_reads());
  return message;
}

void set_rotation(const Eigen::Quaterniond& q, msgs::Quaternion& to) {
  to.set_w(q.w());
  to.set_x(q.x());
  to.set_y(q.y());
  to.set_z(q.z());
}

void add_tag(const std::string& id, const Eigen::Vector3d& p_WT, msgs::TagPositions& message) {
  msgs::TagPosition& tag = *message.add_tags();
  tag.set_epc(id);
  set_vector(p_WT, *tag.mutable_position());
}

/// The part of a topic's name before "rfid": letters, digits, '_' and '/' stay, others become '_'.
std::string topic_prefix(const std::string& name_space) {
  std::string prefix = "/";
  for (const char c : name_space) {
    const bool allowed = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                         (c >= '0' && c <= '9') || c == '_' || c == '/';
    if (c == '/' && prefix.back() == '/') continue;
    prefix += allowed ? c : '_';
  }
  return prefix.back() == '/' ? prefix : prefix + "/";
}

}  // namespace

struct TransportPublisher::AntennaTopics {
  AntennaTopics(gz_transport::Node& node, const std::string& prefix)
      : reads(node.Advertise<msgs::TagReads>(prefix + "rfid/reads")),
        truth(node.Advertise<msgs::AntennaTruth>(prefix + "rfid/truth/antennas")) {}
  gz_transport::Node::Publisher reads;
  gz_transport::Node::Publisher truth;
};

struct TransportPublisher::Topics {
  gz_transport::Node node;
  gz_transport::Node::Publisher tags = node.Advertise<msgs::TagPositions>("/rfid/truth/tags");
  gz_transport::Node::Publisher moved =
      node.Advertise<msgs::TagPositions>("/rfid/truth/tags_moved");
  std::map<std::string, AntennaTopics> antennas;  ///< By namespace.
};

TransportPublisher::TransportPublisher() : topics_(std::make_unique<Topics>()) {}
TransportPublisher::~TransportPublisher() = default;

TransportPublisher::AntennaTopics& TransportPublisher::topics_in(const std::string& name_space) {
  const auto found = topics_->antennas.find(name_space);
  if (found != topics_->antennas.end()) return found->second;
  return topics_->antennas.try_emplace(name_space, topics_->node, topic_prefix(name_space))
      .first->second;
}

void TransportPublisher::on_antenna_added(const AntennaInfo& antenna) {
  topics_in(antenna.name_space);
}

void TransportPublisher::on_antenna_removed(const std::string& name) { updates_.erase(name); }

void TransportPublisher::on_read(const TagRead& read) {
  updates_[read.antenna].reads.push_back(read);
}

void TransportPublisher::on_distance(const TrueDistance& distance) {
  updates_[distance.antenna].distances_m.push_back(distance.distance_m);
}

void TransportPublisher::on_antenna_pose(const AntennaInfo& antenna, const AntennaPose& pose) {
  updates_[antenna.name].X_WA = pose.X_WA;
}

void TransportPublisher::on_update(const AntennaInfo& antenna, Time stamp) {
  // Tags at rest are not reported again, so late subscribers have not received them.
  if (are_tags_due(stamp)) publish_tags(stamp);
  const Update update = std::exchange(updates_[antenna.name], {});
  AntennaTopics& topics = topics_in(antenna.name_space);
  if (topics.reads.HasConnections()) {
    topics.reads.Publish(reads_message(antenna, stamp, update.reads));
  }
  if (!topics.truth.HasConnections()) return;
  msgs::AntennaTruth truth;
  set_time(stamp, *truth.mutable_stamp());
  truth.set_antenna(antenna.name);
  set_vector(update.X_WA.translation, *truth.mutable_position());
  set_rotation(update.X_WA.rotation, *truth.mutable_orientation());
  for (std::size_t i = 0; i < update.distances_m.size() && i < update.reads.size(); ++i) {
    msgs::AntennaTruth::Distance& distance = *truth.add_distances();
    distance.set_epc(update.reads[i].tag);
    distance.set_distance_m(update.distances_m[i]);
  }
  topics.truth.Publish(truth);
}

void TransportPublisher::on_tag_added(const TagPosition& tag, const std::string& /*label*/) {
  places_[tag.tag] = tag.p_WT;
  has_changed_ = true;
}

void TransportPublisher::on_tag_removed(const std::string& id) {
  places_.erase(id);
  moved_.erase(id);
  has_changed_ = true;
}

void TransportPublisher::on_tag_moved(const TagPosition& tag) {
  places_[tag.tag] = tag.p_WT;
  moved_.insert(tag.tag);
}

bool TransportPublisher::are_tags_due(Time stamp) const {
  return has_changed_ || last_sent_ == Time::min() || stamp - last_sent_ >= kTagsInterval;
}

void TransportPublisher::publish_tags(Time stamp) {
  has_changed_ = false;
  last_sent_ = stamp;
  if (!topics_->tags.HasConnections()) return;
  msgs::TagPositions all;
  set_time(stamp, *all.mutable_stamp());
  for (const auto& [id, p_WT] : places_) add_tag(id, p_WT, all);
  topics_->tags.Publish(all);
}

void TransportPublisher::on_tags_placed(Time stamp) {
  if (are_tags_due(stamp)) publish_tags(stamp);
  const std::set<std::string> moved = std::exchange(moved_, {});
  if (moved.empty() || !topics_->moved.HasConnections()) return;
  msgs::TagPositions message;
  set_time(stamp, *message.mutable_stamp());
  for (const std::string& id : moved) add_tag(id, places_.at(id), message);
  topics_->moved.Publish(message);
}

void TransportPublisher::on_restart() {
  updates_.clear();
  last_sent_ = Time::min();
}

}  // namespace tagfield
