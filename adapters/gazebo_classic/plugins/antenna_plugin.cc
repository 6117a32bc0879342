// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_classic/plugins/antenna_plugin.h"

#include <fmt/format.h>

#include <gazebo/physics/physics.hh>
#include <gazebo/sensors/sensors.hh>

#include "adapters/gazebo_classic/conversions.h"
#include "adapters/gazebo_classic/plugins/shared_world.h"
#include "adapters/gazebo_classic/sensor_context.h"
#include "adapters/gazebo_common/sensor_names.h"
#include "tagfield/base/error.h"
#include "tagfield/settings/sensor_parameters.h"

namespace gazebo {
RfidAntennaPlugin::~RfidAntennaPlugin() {
  if (world_) world_->remove_antenna(handle_);
}

void RfidAntennaPlugin::Load(sensors::SensorPtr sensor, sdf::ElementPtr plugin) {
  try {
    load(sensor, plugin);
  } catch (const std::exception& error) {
    gzerr << tagfield::place_of(*sensor) << ": " << error.what() << "; stays off\n";
  }
  // Updates are triggered by the world's steps, so Gazebo need not update the sensor.
  sensor->SetActive(false);
}

void RfidAntennaPlugin::load(const sensors::SensorPtr& sensor, const sdf::ElementPtr& plugin) {
  if (!std::dynamic_pointer_cast<sensors::RFIDSensor>(sensor)) {
    throw tagfield::Error(
        fmt::format("sensor type is '{}', expected 'rfid' for an antenna", sensor->Type()));
  }
  tagfield::Diagnostics diagnostics;
  const tagfield::SensorAntenna described =
      tagfield::antenna_from(sensor->Name(), tagfield::parameters_of(plugin), {}, diagnostics);
  for (const std::string& warning : diagnostics.warnings()) {
    gzwarn << tagfield::place_of(*sensor) << ": " << warning << "\n";
  }
  tagfield::AntennaOnLink antenna;
  antenna.place = tagfield::place_of(*sensor);
  antenna.link = sensor->ParentName();
  antenna.X_LA = tagfield::from_gazebo(sensor->Pose());
  antenna.antenna = tagfield::field_antenna(sensor->Name(), described);
  const auto world = tagfield::shared_rfid_world(physics::get_world(sensor->WorldName()));
  antenna.model = tagfield::model_name_of(*sensor);
  handle_ = world->add_antenna(std::move(antenna));
  world_ = world;
}

GZ_REGISTER_SENSOR_PLUGIN(RfidAntennaPlugin)

}  // namespace gazebo
