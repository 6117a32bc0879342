// SPDX-License-Identifier: Apache-2.0
/// @file
/// libgazeboRfidAntennaPlugin.so: a reader's antenna on an `rfid` sensor.
///
///     <sensor name="antenna" type="rfid">
///       <update_rate>15</update_rate>                    <!-- Hz; default 15 -->
///       <pose>0 0 0 0 0 0</pose>                         <!-- of the antenna on its link -->
///       <plugin name="antenna" filename="libgazeboRfidAntennaPlugin.so">
///         <!-- Parameters of the published plugin -->
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
///         <model>paper</model>              <!-- paper | link_budget | multipath; paper -->
///         <seed>1</seed>                    <!-- of all random draws; 1 -->
///         <phase_offset>0</phase_offset>    <!-- rad; 0 -->
///         <range_sigma>0.05</range_sigma>   <!-- relative spread of the range; 0.05 -->
///         <sensitivity_dbm>-70</sensitivity_dbm> <!-- least RSSI that is reported; none -->
///         <robotNamespace></robotNamespace> <!-- of rfid/reads and rfid/truth/antennas; none -->
///         <frame_id>gate</frame_id>         <!-- of the antenna; default: its name -->
///         <parent_frame>base_link</parent_frame> <!-- link of this model that is the frame's
///                              parent in tf; default: none, or the world for a static model -->
///       </plugin>
///     </sensor>
///
/// With the models link_budget and multipath (docs/gazebo.md, "Physical models"), `frequency`, the
/// carrier, is the only one of the published parameters that is used. All antenna settings of
/// docs/scenario.md are available as elements; later ones override earlier ones:
///
///     <transmit_power_dbm>30</transmit_power_dbm>  <!-- dBm at the reader's port; 30 -->
///     <cable_loss_db>0</cable_loss_db>             <!-- dB one way; 0 -->
///     <receive_pose>0 0 0 0 0 0</receive_pose>     <!-- m, rad; receiving antenna; the same -->
///     <reflection_order>2</reflection_order>       <!-- 0 to 3; 2 with multipath -->
///     <diffuse_k_db>6</diffuse_k_db>               <!-- dB; Rician K factor; no diffuse waves -->
///     <without>noise hopping</without>             <!-- effects to leave out; none -->
///     <pattern>patch</pattern>                     <!-- isotropic, patch, dipole, table; patch -->
///     <gain_dbi>8</gain_dbi>                       <!-- dBi; 8 -->
///     <beam_width_deg>65</beam_width_deg>          <!-- deg, of a patch; 65 -->
///     <vertical_beam_width_deg>65</vertical_beam_width_deg> <!-- deg; as the one above -->
///     <front_to_back_db>20</front_to_back_db>      <!-- dB, of a patch -->
///     <pattern_table></pattern_table>              <!-- deg dBi dBi, triples -->
///     <polarization>right_circular</polarization>  <!-- linear, right_circular, left_circular -->
///     <tilt_deg>0</tilt_deg>                       <!-- deg from z towards y; 0 -->
///     <channel_plan>etsi_low</channel_plan>        <!-- etsi_low | etsi_high | fcc | china |
///     fixed;
///                                                       one carrier, <frequency> -->
///     <carriers_hz></carriers_hz>                  <!-- Hz; the plan's -->
///     <dwell_s>0.2</dwell_s>                       <!-- s on each carrier; the plan's -->
///     <sensitivity_dbm>-84</sensitivity_dbm>       <!-- dBm; -84 -->
///     <noise_figure_db>25</noise_figure_db>        <!-- dB; 25 -->
///     <bandwidth_hz>250e3</bandwidth_hz>           <!-- Hz; 250e3 -->
///     <averaged_bits>16</averaged_bits>            <!-- 16 -->
///     <phase_floor_rad>0.03</phase_floor_rad>      <!-- rad; 0.03 -->
///     <phase_steps>4096</phase_steps>              <!-- per cycle, 0 for none; 4096 -->
///     <rssi_step_db>0.5</rssi_step_db>             <!-- dB, 0 for none; 0.5 -->
///     <doppler_step_hz>0.0625</doppler_step_hz>    <!-- Hz, 0 for none; 1/16 -->
///     <reply_s>2e-3</reply_s>                      <!-- s, for Doppler; 2e-3 -->
///     <inventory>gen2</inventory>                  <!-- none | gen2; none. With gen2 also
///       session, target, adaptive_q, start_q, min_q, max_q, q_step, capture_db, power_up_s,
///       round_overhead_s, slot_overhead_s, read_overhead_s, port_dwell_s, sharing, tari_us,
///       data1_tari, blf_khz, divide_ratio, encoding, pilot, epc_bits: see
///       tagfield/gen2/inventory_settings.h and link_timing.h -->
///
/// An invalid parameter causes one error that names model, link, sensor and parameter; that antenna
/// then stays off and everything else continues.
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
