// SPDX-License-Identifier: Apache-2.0
// A program of another DDS (Fast DDS) that listens to topics as ROS 2's nodes do: the test's
// witness that what is sent arrives elsewhere too.
//
//     ros2_listener DOMAIN[:local] SECONDS_WITHOUT_NEWS TOPIC=TYPE[:transient_local|:best_effort] …
//
// With ":local" it knows no multicast, and looks for others on this machine alone.
// Prints a JSON line for each participant, writer and message: kind, name, what it tells of itself,
// and the bytes of messages in hexadecimal. Ends once nothing has come for so long.
#include <atomic>
#include <chrono>
#include <cstdio>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <iomanip>
#include <iostream>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "fast_dds.h"

namespace {

using Clock = std::chrono::steady_clock;
using Bytes = std::vector<unsigned char>;

std::mutex printing;
std::atomic<Clock::rep> last_news{0};

void note_news() { last_news = Clock::now().time_since_epoch().count(); }

void print(const std::string& line) {
  const std::lock_guard<std::mutex> lock(printing);
  std::cout << line << '\n' << std::flush;
  note_news();
}

std::string hexadecimal(const Bytes& bytes) {
  std::ostringstream text;
  for (const unsigned char byte : bytes) {
    text << std::hex << std::setw(2) << std::setfill('0') << static_cast<int>(byte);
  }
  return text.str();
}

/// Any type: the bytes as they came.
class RawType : public FastType {
 public:
  explicit RawType(const std::string& name) : FastType(name, 1'000'000) {}
  bool read(const rtps::SerializedPayload_t& payload, void* data) override {
    static_cast<Bytes*>(data)->assign(payload.data, payload.data + payload.length);
    return true;
  }
  void* create() override { return new Bytes; }
  void destroy(void* data) override { delete static_cast<Bytes*>(data); }
};

class Discovery : public FastDiscovery {
 public:
  void found_participant(const std::string& user_data) override {
    print(R"({"kind": "participant", "user_data": ")" + user_data + "\"}");
  }
  void found_writer(const std::string& topic, const std::string& type,
                    const std::string& user_data) override {
    print(R"({"kind": "writer", "topic": ")" + topic + R"(", "type": ")" + type +
          R"(", "user_data": ")" + user_data + "\"}");
  }
};

class Messages : public fast::DataReaderListener {
 public:
  void on_data_available(fast::DataReader* reader) override {
    Bytes bytes;
    fast::SampleInfo info;
    while (reader->take_next_sample(&bytes, &info) == fast_ok) {
      if (!info.valid_data) continue;
      print(R"({"kind": "message", "topic": ")" + reader->get_topicdescription()->get_name() +
            R"(", "cdr": ")" + hexadecimal(bytes) + "\"}");
    }
  }
};

fast::DataReaderQos qos_of(const std::string& delivery) {
  fast::DataReaderQos qos;
  qos.history().kind = fast::KEEP_ALL_HISTORY_QOS;
  qos.reliability().kind = delivery == "best_effort" ? fast::BEST_EFFORT_RELIABILITY_QOS
                                                     : fast::RELIABLE_RELIABILITY_QOS;
  if (delivery == "transient_local") qos.durability().kind = fast::TRANSIENT_LOCAL_DURABILITY_QOS;
  return qos;
}

fast::DomainParticipantQos participant_qos(bool local) {
  fast::DomainParticipantQos qos = fast::PARTICIPANT_QOS_DEFAULT;
  if (!local) return qos;
  rtps::Locator_t here;
  rtps::IPLocator::setIPv4(here, "127.0.0.1");
  auto& builtin = qos.wire_protocol().builtin;
  // Where an address of one's own is named there is no multicast.
  builtin.metatrafficUnicastLocatorList.push_back(here);
  builtin.initialPeersList.push_back(here);
  return qos;
}

}  // namespace

int main(int count, char** words) {
  if (count < 4) return 2;
  const std::string domain = words[1];
  const std::chrono::duration<double> patience(std::stod(words[2]));
  Discovery discovery;
  Messages messages;
  fast::DomainParticipant* const participant =
      fast::DomainParticipantFactory::get_instance()->create_participant(
          static_cast<std::uint32_t>(std::stoul(domain)),
          participant_qos(domain.find(":local") != std::string::npos), &discovery,
          fast::StatusMask::none());
  if (participant == nullptr) return 1;
  fast::Subscriber* const subscriber =
      participant->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT, nullptr);
  for (int i = 3; i < count; ++i) {
    const std::string word = words[i];
    const std::size_t equals = word.find('=');
    const std::size_t delivery = word.find(':', word.rfind("::") + 2);
    const std::string type = word.substr(equals + 1, delivery - equals - 1);
    fast::TypeSupport(new RawType(type)).register_type(participant);
    fast::Topic* const topic =
        participant->create_topic(word.substr(0, equals), type, fast::TOPIC_QOS_DEFAULT);
    subscriber->create_datareader(
        topic, qos_of(delivery == std::string::npos ? "" : word.substr(delivery + 1)), &messages);
  }
  print(R"({"kind": "ready"})");
  while (Clock::now().time_since_epoch() - Clock::duration(last_news.load()) < patience) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  // Threads of the library may still print: nothing is torn down under them.
  std::cout.flush();
  std::quick_exit(0);
}
