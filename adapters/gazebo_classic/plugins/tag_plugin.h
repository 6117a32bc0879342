// SPDX-License-Identifier: Apache-2.0
/// @file
/// libgazeboRfidTagPlugin.so: a tag on an `rfidtag` sensor, at the sensor's pose.
///
///     <sensor name="tag" type="rfidtag">
///       <pose>0 0 0 0 0 0</pose>        <!-- of the tag on its link -->
///       <plugin name="tag" filename="libgazeboRfidTagPlugin.so">
///         <epc>E28011700000020A</epc>   <!-- its ID, unique; default: its model's name, and
///                                            MODEL::SENSOR if the model has several tags -->
///         <!-- Its kind, for antennas with physical models: its face points along x, z is up -->
///         <pattern>dipole</pattern>           <!-- isotropic | patch | dipole | table; dipole -->
///         <gain_dbi>2.15</gain_dbi>           <!-- dBi; 2.15 -->
///         <polarization>linear</polarization> <!-- linear, right_circular, left_circular -->
///         <tilt_deg>0</tilt_deg>              <!-- deg from z towards y; 0 -->
///         <sensitivity_dbm>-18</sensitivity_dbm> <!-- dBm at the chip; -18 -->
///         <modulation_db>-5</modulation_db>   <!-- dB, backscattered over absorbed; -5 -->
///         <detuning_db>0</detuning_db>        <!-- dB each way, due to mounting; 0 -->
///       </plugin>
///     </sensor>
///
/// Patches and tables also have the settings beam_width_deg, vertical_beam_width_deg,
/// front_to_back_db and pattern_table, as antennas do (antenna_plugin.h).
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
