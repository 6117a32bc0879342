// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/mcap_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "adapters/mcap/mcap_writer.h"

namespace tagfield::ros2 {
namespace {

/// QoS in rosbag2's YAML format, with the values of rmw's enumerations, so that a replay offers the
/// topic with the same QoS.
std::string offered_qos(Delivery delivery) {
  constexpr const char* kForever = "{sec: 9223372036, nsec: 854775807}";
  return fmt::format(
      "- history: 1\n  depth: {}\n  reliability: {}\n  durability: {}\n  deadline: {}\n"
      "  lifespan: {}\n  liveliness: 1\n  liveliness_lease_duration: {}\n"
      "  avoid_ros_namespace_conventions: false\n",
      delivery == Delivery::kReliable ? 1000 : 1, delivery == Delivery::kBestEffort ? 2 : 1,
      delivery == Delivery::kLatched ? 1 : 2, kForever, kForever, kForever);
}

class McapSink : public MessageSink {
 public:
  explicit McapSink(const std::string& path) : writer_(path) {}

  std::size_t advertise(const Ros2Topic& topic, const Ros2Type& type) override;
  void publish(std::size_t topic, Time stamp, const void* message) override;
  void finish() override { writer_.finish(); }

 private:
  struct Topic {
    McapChannelId channel = 0;
    const Ros2Type* type = nullptr;
  };
  McapWriter writer_;
  std::vector<Topic> topics_;
  std::map<std::string, std::size_t> by_name_;
};

std::size_t McapSink::advertise(const Ros2Topic& topic, const Ros2Type& type) {
  // A topic of several publishers is one channel.
  const auto known = by_name_.find(topic.name);
  if (known != by_name_.end() && topics_.at(known->second).type->name == type.name)
    return known->second;
  McapChannel channel;
  channel.topic = topic.name;
  channel.schema =
      std::make_shared<const McapSchema>(McapSchema{type.name, "ros2msg", type.definition});
  channel.metadata = {{"offered_qos_profiles", offered_qos(topic.delivery)},
                      {"topic_type_hash", type.hash}};
  topics_.push_back({writer_.add_channel(channel), &type});
  by_name_[topic.name] = topics_.size() - 1;
  return topics_.size() - 1;
}

void McapSink::publish(std::size_t topic, Time stamp, const void* message) {
  // MCAP times can't be negative, and simulations begin at 0.
  const auto time_ns =
      static_cast<std::uint64_t>(std::max<Duration::rep>(stamp.time_since_epoch().count(), 0));
  writer_.write(topics_.at(topic).channel, time_ns, time_ns,
                topics_.at(topic).type->to_cdr(message));
}

}  // namespace

std::shared_ptr<MessageSink> mcap_file(const std::string& path) {
  return std::make_shared<McapSink>(path);
}

}  // namespace tagfield::ros2
