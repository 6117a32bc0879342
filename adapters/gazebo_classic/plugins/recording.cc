// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_classic/plugins/recording.h"

#include <exception>
#include <gazebo/common/Console.hh>
#include <gazebo/physics/World.hh>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "adapters/gazebo_classic/plugin_elements.h"
#include "adapters/ros2/mcap_file.h"
#include "adapters/ros2/tee_sink.h"

namespace tagfield {
namespace {

constexpr const char* kRecordingFile = "TagfieldRecordingPlugin";

/// Reports errors: a failing recording must not end the simulation.
template <class Task>
void run_reporting_errors(const Task& task) {
  try {
    task();
  } catch (const std::exception& error) {
    gzerr << "Tagfield: " << error.what() << "; nothing more is recorded there\n";
  }
}

using Sinks = std::vector<std::shared_ptr<ros2::MessageSink>>;

class Recording : public ros2::MessageSink {
 public:
  explicit Recording(Sinks files) : files_(std::move(files)) {}
  ~Recording() override {
    run_reporting_errors([this] { files_.finish(); });
  }
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  std::size_t advertise(const ros2::Ros2Topic& topic, const ros2::Ros2Type& type) override {
    const std::lock_guard lock(mutex_);
    return files_.advertise(topic, type);
  }
  void publish(std::size_t topic, Time stamp, const void* message) override {
    const std::lock_guard lock(mutex_);
    run_reporting_errors([&] { files_.publish(topic, stamp, message); });
  }

 private:
  std::mutex mutex_;
  ros2::TeeSink files_;
};

Sinks files_of(gazebo::physics::World& world) {
  Sinks files;
  for (const sdf::ElementPtr& plugin : children(world.SDF(), "plugin")) {
    if (plugin->Get<std::string>("filename").find(kRecordingFile) == std::string::npos) continue;
    for (const sdf::ElementPtr& file : children(plugin, "mcap")) {
      run_reporting_errors([&] { files.push_back(ros2::mcap_file(file->Get<std::string>())); });
    }
  }
  return files;
}

/// The recording of one world, while there are references to it; opened only once.
struct Known {
  bool is_tried = false;
  std::weak_ptr<ros2::MessageSink> recording;
};

}  // namespace

std::shared_ptr<ros2::MessageSink> shared_recording(const gazebo::physics::WorldPtr& world) {
  // As with shared_rfid_world(), plugins have no other way to share state.
  static std::mutex mutex;
  static std::map<std::string, Known> worlds;
  const std::lock_guard lock(mutex);
  Known& known = worlds[world->Name()];
  if (std::exchange(known.is_tried, true)) return known.recording.lock();
  Sinks files = files_of(*world);
  if (files.empty()) return nullptr;
  const auto recording = std::make_shared<Recording>(std::move(files));
  known.recording = recording;
  return recording;
}

}  // namespace tagfield
