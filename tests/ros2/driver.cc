// SPDX-License-Identifier: Apache-2.0
// A program of another DDS (Fast DDS) that sends velocities, as Nav2 would: SECONDS of FORWARD and
// TURN, ten a second, as Twist or TwistStamped.
//
//     ros2_driver DOMAIN SECONDS FORWARD TURN [stamped]
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

/// CDR of six numbers: they follow one another. Before them, where it is stamped, are a time of 0
/// and an empty name of a frame: 4 and 4 bytes, its length of 4, '\0', and 3 up to a multiple of 8.
class TwistType : public FastType {
 public:
  explicit TwistType(bool stamped)
      : FastType(stamped ? "geometry_msgs::msg::dds_::TwistStamped_"
                         : "geometry_msgs::msg::dds_::Twist_",
                 sizeof(Twist) + 4 + (stamped ? 16 : 0)),
        stamped_(stamped) {}
  bool write(const void* data, rtps::SerializedPayload_t& payload) override {
    std::string bytes("\0\1\0\0", 4);
    if (stamped_) bytes += std::string(8, '\0') + std::string("\1\0\0\0", 4) + std::string(4, '\0');
    bytes.append(static_cast<const char*>(data), sizeof(Twist));
    std::memcpy(payload.data, bytes.data(), bytes.size());
    payload.length = static_cast<std::uint32_t>(bytes.size());
    return true;
  }
  void* create() override { return new Twist; }
  void destroy(void* data) override { delete static_cast<Twist*>(data); }

 private:
  bool stamped_;
};

}  // namespace

int main(int count, char** words) {
  const bool stamped = count == 6 && std::string(words[5]) == "stamped";
  if (count != 5 && !stamped) return 2;
  fast::DomainParticipant* const participant =
      fast::DomainParticipantFactory::get_instance()->create_participant(
          static_cast<std::uint32_t>(std::stoul(words[1])), fast::PARTICIPANT_QOS_DEFAULT);
  if (participant == nullptr) return 1;
  const fast::TypeSupport type(new TwistType(stamped));
  type.register_type(participant);
  fast::Topic* const topic =
      participant->create_topic("rt/cmd_vel", type.get_type_name(), fast::TOPIC_QOS_DEFAULT);
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
