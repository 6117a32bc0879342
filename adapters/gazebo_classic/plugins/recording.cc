#include "adapters/gazebo_classic/plugins/recording.h"

#include <exception>
#include <gazebo/common/Console.hh>
#include <gazebo/physics/World.hh>
#include <string>

#include "adapters/gazebo_classic/plugin_elements.h"
#include "adapters/ros2/mcap_file.h"
#include "adapters/ros2/ros2_outlet.h"

namespace tagfield {
namespace {

constexpr const char* kFilename = "TagfieldRecordingPlugin";

void attach_recording(const std::string& path, Recordings& recordings, Outlets& outlets) {
  recordings.push_back(ros2::mcap_file(path));
  attach(std::make_shared<ros2::Ros2Outlet>(recordings.back()), outlets);
  attach(std::make_shared<ros2::Ros2Markers>(recordings.back()), outlets);
}

}  // namespace

Recordings attach_recordings(gazebo::physics::World& world, Outlets& outlets) {
  Recordings recordings;
  for (const sdf::ElementPtr& plugin : children(world.SDF(), "plugin")) {
    if (plugin->Get<std::string>("filename").find(kFilename) == std::string::npos) continue;
    for (const sdf::ElementPtr& file : children(plugin, "mcap")) {
      try {
        attach_recording(file->Get<std::string>(), recordings, outlets);
      } catch (const std::exception& error) {
        gzerr << "Tagfield: " << error.what() << "; nothing is recorded there\n";
      }
    }
  }
  return recordings;
}

void finish(const Recordings& recordings) {
  for (const auto& recording : recordings) {
    try {
      recording->finish();
    } catch (const std::exception& error) {
      gzerr << "Tagfield: " << error.what() << "\n";
    }
  }
}

}  // namespace tagfield
