/// @file
/// libgazeboRfidTagPlugin.so: a tag on an `rfidtag` sensor, at the sensor's pose.
///
///     <sensor name="tag" type="rfidtag">
///       <pose>0 0 0 0 0 0</pose>        <!-- of the tag on its link -->
///       <plugin name="tag" filename="libgazeboRfidTagPlugin.so">
///         <epc>E28011700000020A</epc>   <!-- its ID, unique; default: its model's name, and
///                                            MODEL::SENSOR where the model has several tags -->
///       </plugin>
///     </sensor>
#pragma once

#include <gazebo/common/Plugin.hh>
#include <memory>

#include "adapters/gazebo_classic/rfid_world.h"

namespace gazebo {

class RfidTagPlugin : public SensorPlugin {
 public:
  RfidTagPlugin() = default;
  ~RfidTagPlugin() override;
  RfidTagPlugin(const RfidTagPlugin&) = delete;
  RfidTagPlugin& operator=(const RfidTagPlugin&) = delete;
  void Load(sensors::SensorPtr sensor, sdf::ElementPtr plugin) override;

 private:
  void load(const sensors::SensorPtr& sensor, const sdf::ElementPtr& plugin);

  std::shared_ptr<tagfield::RfidWorld> world_;
  tagfield::RfidWorld::Handle handle_ = 0;
};

}  // namespace gazebo
