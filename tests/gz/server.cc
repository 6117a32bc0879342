// SPDX-License-Identifier: Apache-2.0
// A gz-sim server for tests, which does what its script says, line by line, and nothing meanwhile:
//
//   gz_test_server WORLD SCRIPT
//
//   run SECONDS            of simulated time, as fast as it goes
//   create FILE            what an SDF file holds comes
//   remove MODEL
//   pose MODEL X Y Z YAW   moves it there
//   reset                  the world begins anew
//   seek SECONDS           simulated time goes there
//   hear TOPIC             from now on its messages are counted
//   window                 from now on there is one that shows markers
//
// Prints the wall time that `run` took, and what was heard: `heard TOPIC TYPE COUNT` and `marker
// NAME_SPACE ID POINTS`, of the last state of each. Exit code 1 if a request is refused.
#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>
#include <map>
#include <mutex>
#include <sstream>
#include <string>

#if TAGFIELD_GZ_SIM == 6
#include <ignition/msgs/boolean.pb.h>
#include <ignition/msgs/entity.pb.h>
#include <ignition/msgs/entity_factory.pb.h>
#include <ignition/msgs/log_playback_control.pb.h>
#include <ignition/msgs/marker.pb.h>
#include <ignition/msgs/pose.pb.h>
#include <ignition/msgs/world_control.pb.h>

#include <ignition/common/Console.hh>
#include <ignition/gazebo/Server.hh>
#include <ignition/transport/Node.hh>
namespace sim = ignition::gazebo;
namespace messages = ignition::msgs;
namespace transport = ignition::transport;
namespace common = ignition::common;
#else
#include <gz/msgs/boolean.pb.h>
#include <gz/msgs/entity.pb.h>
#include <gz/msgs/entity_factory.pb.h>
#include <gz/msgs/log_playback_control.pb.h>
#include <gz/msgs/marker.pb.h>
#include <gz/msgs/pose.pb.h>
#include <gz/msgs/world_control.pb.h>

#include <gz/common/Console.hh>
#include <gz/sim/Server.hh>
#include <gz/transport/Node.hh>
namespace sim = gz::sim;
namespace messages = gz::msgs;
namespace transport = gz::transport;
namespace common = gz::common;
#endif

namespace {

constexpr unsigned kPatience_ms = 10'000;
constexpr double kStep_s = 0.001;

class Script {
 public:
  Script(sim::Server& server, std::string world) : server_(server), world_(std::move(world)) {}

  bool act(const std::string& line) {
    std::istringstream words(line);
    std::string what;
    words >> what;
    if (what == "run") {
      double seconds = 0.0;
      words >> seconds;
      return run(static_cast<std::uint64_t>(seconds / kStep_s + 0.5));
    }
    if (what == "create") {
      messages::EntityFactory request;
      std::string file;
      words >> file;
      request.set_sdf_filename(file);
      return ask("create", request);
    }
    if (what == "remove") {
      messages::Entity request;
      request.set_type(messages::Entity::MODEL);
      words >> *request.mutable_name();
      return ask("remove", request);
    }
    if (what == "pose") return ask("set_pose", pose_in(words));
    if (what == "seek") {
      messages::LogPlaybackControl request;
      std::int64_t seconds = 0;
      words >> seconds;
      request.mutable_seek()->set_sec(seconds);
      return ask("playback/control", request);
    }
    if (what == "hear") return hear(words);
    if (what == "window") return node_.Advertise("/marker", &Script::show, this);
    if (what == "reset") {
      messages::WorldControl request;
      request.set_pause(false);
      request.mutable_reset()->set_all(true);
      return ask("control", request);
    }
    std::cerr << "unknown: " << line << "\n";
    return false;
  }

  void report() {
    std::cout << "wall " << wall_s_ << "\n";
    const std::lock_guard lock(mutex_);
    for (const auto& [what, count] : heard_) std::cout << "heard " << what << " " << count << "\n";
    for (const auto& [which, points] : shown_) {
      std::cout << "marker " << which.first << " " << which.second << " " << points << "\n";
    }
  }

 private:
  static messages::Pose pose_in(std::istream& words) {
    messages::Pose request;
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
    double yaw = 0.0;
    words >> *request.mutable_name() >> x >> y >> z >> yaw;
    request.mutable_position()->set_x(x);
    request.mutable_position()->set_y(y);
    request.mutable_position()->set_z(z);
    request.mutable_orientation()->set_w(std::cos(0.5 * yaw));
    request.mutable_orientation()->set_z(std::sin(0.5 * yaw));
    return request;
  }

  bool hear(std::istream& words) {
    std::string topic;
    words >> topic;
    return node_.SubscribeRaw(
        topic, [this, topic](const char*, std::size_t, const transport::MessageInfo& info) {
          const std::lock_guard lock(mutex_);
          ++heard_[topic + " " + info.Type()];
        });
  }

  void show(const messages::Marker& marker) {
    const std::lock_guard lock(mutex_);
    const std::pair<std::string, std::uint64_t> which(marker.ns(), marker.id());
    if (marker.action() == messages::Marker::DELETE_MARKER) {
      shown_.erase(which);
    } else {
      shown_[which] = marker.point_size();
    }
  }

  bool run(std::uint64_t steps) {
    const auto begin = std::chrono::steady_clock::now();
    const bool done = server_.Run(true, steps, false);
    wall_s_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return done;
  }

  template <class Request>
  bool ask(const std::string& service, const Request& request) {
    messages::Boolean reply;
    bool result = false;
    const std::string name = "/world/" + world_ + "/" + service;
    const bool heard = node_.Request(name, request, kPatience_ms, reply, result);
    if (heard && result && reply.data()) return true;
    std::cerr << name << ": refused\n";
    return false;
  }

  sim::Server& server_;
  std::string world_;
  double wall_s_ = 0.0;
  std::mutex mutex_;
  std::map<std::string, int> heard_;                            ///< Messages, by topic and type.
  std::map<std::pair<std::string, std::uint64_t>, int> shown_;  ///< Points of each marker.
  transport::Node node_;  // Last, as it calls back until it goes.
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: gz_test_server WORLD SCRIPT\n";
    return 2;
  }
  common::Console::SetVerbosity(3);
  sim::ServerConfig config;
  if (!config.SetSdfFile(argv[1])) return 2;
  sim::Server server(config);
  std::ifstream lines(argv[2]);
  std::string line;
  // The world's name stands in the script's first line.
  if (!std::getline(lines, line)) return 2;
  Script script(server, line);
  while (std::getline(lines, line)) {
    if (!line.empty() && !script.act(line)) return 1;
  }
  script.report();
  return 0;
}
