// SPDX-License-Identifier: Apache-2.0
// A program of another DDS (Fast DDS) that sends velocities, as Nav2 would: SECONDS of FORWARD and
// TURN, ten a second.
//
//     ros2_driver DOMAIN SECONDS FORWARD TURN
#include <array>
#include <chrono>
#include <cstring>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <string>
#include <thread>

#include "fast_dds.h"

namespace {

using Twist = std::array<double, 6>;  // linear x y z, angular x y z

/// CDR of six numbers: they follow one another.
class TwistType : public FastType {
 public:
  TwistType() : FastType("geometry_msgs::msg::dds_::Twist_", sizeof(Twist) + 4) {}
  bool write(const void* data, rtps::SerializedPayload_t& payload) override {
    const unsigned char header[] = {0, 1, 0, 0};
    std::memcpy(payload.data, header, sizeof header);
    std::memcpy(payload.data + sizeof header, data, sizeof(Twist));
    payload.length = sizeof header + sizeof(Twist);
    return true;
  }
  void* create() override { return new Twist; }
  void destroy(void* data) override { delete static_cast<Twist*>(data); }
};

}  // namespace

int main(int count, char** words) {
  if (count != 5) return 2;
  fast::DomainParticipant* const participant =
      fast::DomainParticipantFactory::get_instance()->create_participant(
          static_cast<std::uint32_t>(std::stoul(words[1])), fast::PARTICIPANT_QOS_DEFAULT);
  if (participant == nullptr) return 1;
  fast::TypeSupport(new TwistType).register_type(participant);
  fast::Topic* const topic = participant->create_topic(
      "rt/cmd_vel", "geometry_msgs::msg::dds_::Twist_", fast::TOPIC_QOS_DEFAULT);
  fast::Publisher* const publisher = participant->create_publisher(fast::PUBLISHER_QOS_DEFAULT);
  fast::DataWriterQos qos;
  qos.reliability().kind = fast::RELIABLE_RELIABILITY_QOS;
  fast::DataWriter* const writer = publisher->create_datawriter(topic, qos);
  Twist twist = {std::stod(words[3]), 0, 0, 0, 0, std::stod(words[4])};
  const auto end =
      std::chrono::steady_clock::now() + std::chrono::duration<double>(std::stod(words[2]));
  while (std::chrono::steady_clock::now() < end) {
    writer->write(&twist);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  std::quick_exit(0);
}
