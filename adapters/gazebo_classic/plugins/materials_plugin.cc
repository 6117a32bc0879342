// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_classic/plugins/materials_plugin.h"

#include <gazebo/common/Console.hh>
#include <gazebo/physics/physics.hh>

#include "adapters/gazebo_classic/plugins/shared_world.h"
#include "adapters/gazebo_common/world_materials.h"

namespace gazebo {

void TagfieldMaterialsPlugin::Load(physics::WorldPtr world, sdf::ElementPtr plugin) {
  const std::string place = "world '" + world->Name() + "', plugin '" + GetHandle() + "': ";
  try {
    tagfield::Diagnostics diagnostics;
    tagfield::RadioWorldOptions materials = tagfield::materials_in(plugin, diagnostics);
    for (const std::string& warning : diagnostics.warnings()) gzwarn << place << warning << "\n";
    world_ = tagfield::shared_rfid_world(world);
    world_->set_materials(std::move(materials));
  } catch (const std::exception& error) {
    gzerr << place << error.what() << "; left out\n";
  }
}

GZ_REGISTER_WORLD_PLUGIN(TagfieldMaterialsPlugin)

}  // namespace gazebo
