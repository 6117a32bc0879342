// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_classic/plugins/recording_plugin.h"

#include <fmt/format.h>

#include <gazebo/common/Console.hh>
#include <gazebo/physics/World.hh>

#include "adapters/gazebo_classic/plugin_elements.h"
#include "adapters/gazebo_classic/plugins/shared_world.h"

namespace gazebo {

void TagfieldRecordingPlugin::Load(physics::WorldPtr world, sdf::ElementPtr plugin) {
  const std::string place = fmt::format("world '{}', plugin '{}': ", world->Name(), GetHandle());
  const auto parameters = tagfield::parameters_in(plugin);
  if (parameters.empty()) gzerr << place << "has no <mcap>: nothing is recorded\n";
  for (const tagfield::RawParameter& parameter : parameters) {
    if (parameter.key == "mcap") continue;
    gzerr << place << "unknown element <" << parameter.key << ">, expected <mcap>\n";
  }
  world_ = tagfield::shared_rfid_world(world);
}

GZ_REGISTER_WORLD_PLUGIN(TagfieldRecordingPlugin)

}  // namespace gazebo
