// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_classic/plugins/tag_plugin.h"

#include <fmt/format.h>

#include <gazebo/physics/physics.hh>
#include <gazebo/sensors/sensors.hh>

#include "adapters/gazebo_classic/conversions.h"
#include "adapters/gazebo_classic/plugins/shared_world.h"
#include "adapters/gazebo_classic/sensor_context.h"
#include "tagfield/base/error.h"
#include "tagfield/settings/sensor_parameters.h"

namespace gazebo {

RfidTagPlugin::~RfidTagPlugin() {
  if (world_) world_->remove_tags(handle_);
}

void RfidTagPlugin::Load(sensors::SensorPtr sensor, sdf::ElementPtr plugin) {
  try {
    load(sensor, plugin);
  } catch (const std::exception& error) {
    gzerr << tagfield::place_of(*sensor) << ": " << error.what() << "; left out\n";
  }
  // A tag needs no updates.
  sensor->SetActive(false);
}

void RfidTagPlugin::load(const sensors::SensorPtr& sensor, const sdf::ElementPtr& plugin) {
  if (!std::dynamic_pointer_cast<sensors::RFIDTag>(sensor)) {
    throw tagfield::Error(
        fmt::format("sensor type is '{}', expected 'rfidtag' for a tag", sensor->Type()));
  }
  tagfield::Diagnostics diagnostics;
  const tagfield::SensorTag tag =
      tagfield::tag_from(tagfield::parameters_of(plugin), {}, diagnostics);
  for (const std::string& warning : diagnostics.warnings()) {
    gzwarn << tagfield::place_of(*sensor) << ": " << warning << "\n";
  }
  const auto world = tagfield::shared_rfid_world(physics::get_world(sensor->WorldName()));
  const tagfield::RigidTransform X_LT = tagfield::from_gazebo(sensor->Pose());
  const auto describe = [tag, X_LT, name = sensor->Name()](physics::Link& link) {
    const std::string id = tag.epc ? *tag.epc : tagfield::tag_id_of(name, link);
    return std::vector<tagfield::TagOnLink>{
        {id, tagfield::published_name_of(name, link), X_LT, tag.model}};
  };
  handle_ = world->add_tags({tagfield::place_of(*sensor), sensor->ParentName(), describe});
  world_ = world;
}

GZ_REGISTER_SENSOR_PLUGIN(RfidTagPlugin)

}  // namespace gazebo
