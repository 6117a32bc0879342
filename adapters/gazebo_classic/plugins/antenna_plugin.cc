#include "adapters/gazebo_classic/plugins/antenna_plugin.h"

#include <fmt/format.h>

#include <gazebo/physics/physics.hh>
#include <gazebo/sensors/sensors.hh>

#include "adapters/gazebo_classic/conversions.h"
#include "adapters/gazebo_classic/plugins/shared_world.h"
#include "adapters/gazebo_classic/sensor_context.h"
#include "tagfield/base/error.h"
#include "tagfield/reader/sensor_parameters.h"

namespace gazebo {
namespace {

constexpr const char* kWorldFrame = "world";

tagfield::FieldAntenna field_antenna(const sensors::Sensor& sensor,
                                     const tagfield::SensorAntenna& described,
                                     const physics::Link& link) {
  tagfield::FieldAntenna antenna;
  antenna.parameters = described.parameters;
  antenna.seed = described.seed;
  antenna.sensor = sensor.Name();
  antenna.name_space = described.name_space;
  antenna.frame_id = described.frame_id;
  antenna.parent_frame = described.parent_frame;
  // What is mounted for good has a known place.
  if (antenna.parent_frame.empty() && link.GetModel()->IsStatic()) {
    antenna.parent_frame = kWorldFrame;
  }
  return antenna;
}

/// The link that the antenna's parent frame is; none for the world.
physics::LinkPtr parent_of(const tagfield::FieldAntenna& antenna, const physics::Link& link) {
  if (antenna.parent_frame.empty() || antenna.parent_frame == kWorldFrame) return nullptr;
  const physics::LinkPtr parent = link.GetModel()->GetLink(antenna.parent_frame);
  if (!parent) {
    throw tagfield::Error(fmt::format("<parent_frame> is '{}', expected a link of model '{}'",
                                      antenna.parent_frame, link.GetModel()->GetName()));
  }
  return parent;
}

/// A second antenna on sensors of one name gets its model's in front, as headless.
void make_unique(const tagfield::RfidWorld& world, const physics::Link& link,
                 const tagfield::SensorAntenna& described, tagfield::FieldAntenna& antenna) {
  const bool named = antenna.parameters.name != antenna.sensor;
  if (named || !world.has_antenna(antenna.sensor)) return;
  const std::string name = fmt::format("{}::{}", link.GetModel()->GetScopedName(), antenna.sensor);
  if (described.parameters.reader == antenna.sensor) antenna.parameters.reader = name;
  if (described.frame_id == antenna.sensor) antenna.frame_id = name;
  antenna.parameters.name = name;
}

}  // namespace

RfidAntennaPlugin::~RfidAntennaPlugin() {
  if (world_) world_->remove_antenna(handle_);
}

void RfidAntennaPlugin::Load(sensors::SensorPtr sensor, sdf::ElementPtr plugin) {
  try {
    load(sensor, plugin);
  } catch (const std::exception& error) {
    gzerr << tagfield::place_of(*sensor) << ": " << error.what() << "; the antenna stays off\n";
  }
  // Updates come from the world's steps, so Gazebo need not look after the sensor.
  sensor->SetActive(false);
}

void RfidAntennaPlugin::load(const sensors::SensorPtr& sensor, const sdf::ElementPtr& plugin) {
  if (!std::dynamic_pointer_cast<sensors::RFIDSensor>(sensor)) {
    throw tagfield::Error(
        fmt::format("sensor type is '{}', expected 'rfid' for an antenna", sensor->Type()));
  }
  tagfield::Diagnostics diagnostics;
  const tagfield::SensorAntenna described = tagfield::antenna_from(
      sensor->Name(), tagfield::parameters_of(*sensor, plugin), {}, diagnostics);
  for (const std::string& warning : diagnostics.warnings()) {
    gzwarn << tagfield::place_of(*sensor) << ": " << warning << "\n";
  }
  tagfield::AntennaOnLink antenna;
  antenna.link = tagfield::link_of(*sensor);
  antenna.X_LA = tagfield::from_gazebo(sensor->Pose());
  antenna.antenna = field_antenna(*sensor, described, *antenna.link);
  antenna.parent = parent_of(antenna.antenna, *antenna.link);
  const auto world = tagfield::shared_rfid_world(physics::get_world(sensor->WorldName()));
  make_unique(*world, *antenna.link, described, antenna.antenna);
  handle_ = world->add_antenna(std::move(antenna));
  world_ = world;
}

GZ_REGISTER_SENSOR_PLUGIN(RfidAntennaPlugin)

}  // namespace gazebo
