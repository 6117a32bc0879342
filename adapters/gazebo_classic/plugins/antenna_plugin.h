/// @file
/// libgazeboRfidAntennaPlugin.so: a reader's antenna on an `rfid` sensor.
///
///     <sensor name="antenna" type="rfid">
///       <update_rate>15</update_rate>                    <!-- Hz; default 15 -->
///       <pose>0 0 0 0 0 0</pose>                         <!-- of the antenna on its link -->
///       <plugin name="antenna" filename="libgazeboRfidAntennaPlugin.so">
///         <!-- The published plugin's parameters -->
///         <frequency>865.7e6</frequency>                 <!-- Hz; 865.7e6 -->
///         <noisephi>0.1</noisephi>                       <!-- rad; 0.1 -->
///         <noiserssi>0.005</noiserssi>                   <!-- amplitude; 0.005 -->
///         <range>5</range>                               <!-- m; 5 -->
///         <communication_gain>250</communication_gain>   <!-- 250 -->
///         <optional_distribution>none</optional_distribution>
///         <optional_distribution_params></optional_distribution_params>
///         <!-- Tagfield's own -->
///         <antenna>gate</antenna>           <!-- unique name; default: the sensor's -->
///         <reader>reader_1</reader>         <!-- its reader's name; default: the antenna's -->
///         <model>paper</model>              <!-- signal model; paper -->
///         <seed>1</seed>                    <!-- of all random draws; 1 -->
///         <phase_offset>0</phase_offset>    <!-- rad; 0 -->
///         <range_sigma>0.05</range_sigma>   <!-- relative spread of the range; 0.05 -->
///         <robotNamespace></robotNamespace> <!-- of rfid/reads and rfid/truth/antennas; none -->
///         <frame_id>gate</frame_id>         <!-- of the antenna; default: its name -->
///         <parent_frame>base_link</parent_frame> <!-- link of this model that tf tells the frame
///                              to hang from; default: none, or the world for a static model -->
///       </plugin>
///     </sensor>
///
/// A parameter that is wrong is one error that names model, link, sensor and parameter; that
/// antenna then stays off and everything else goes on.
#pragma once

#include <gazebo/common/Plugin.hh>
#include <memory>

#include "adapters/gazebo_classic/rfid_world.h"

namespace gazebo {

class RfidAntennaPlugin : public SensorPlugin {
 public:
  RfidAntennaPlugin() = default;
  ~RfidAntennaPlugin() override;
  RfidAntennaPlugin(const RfidAntennaPlugin&) = delete;
  RfidAntennaPlugin& operator=(const RfidAntennaPlugin&) = delete;
  void Load(sensors::SensorPtr sensor, sdf::ElementPtr plugin) override;

 private:
  void load(const sensors::SensorPtr& sensor, const sdf::ElementPtr& plugin);

  std::shared_ptr<tagfield::RfidWorld> world_;
  tagfield::RfidWorld::Handle handle_ = 0;
};

}  // namespace gazebo
