// SPDX-License-Identifier: Apache-2.0
/// @file
/// libTagfieldTagSetPlugin.so: many tags on one model, at no more cost to Gazebo than one.
///
///     <plugin name="tags" filename="libTagfieldTagSetPlugin.so">
///       <link>shelf</link>                         <!-- default: the model's canonical link -->
///       <tag epc="E28011700001">0.3 0 1.2</tag>    <!-- x y z on the link [m] -->
///       <tag epc="E28011700002">0.6 0 1.2 0 0 1.57</tag>  <!-- and roll pitch yaw [rad]; 0 0 0 -->
///       <table>model://shelf/tags.csv</table>      <!-- more of them: epc,x_m,y_m,z_m -->
///       <sensitivity_dbm>-18</sensitivity_dbm>     <!-- their kind, as in tag_plugin.h -->
///     </plugin>
///
/// EPCs are unique in the world. A single invalid row disables the whole set, with one error that
/// names model, plugin and row.
#pragma once

#include <gazebo/common/Plugin.hh>
#include <memory>

#include "adapters/gazebo_classic/rfid_world.h"

namespace gazebo {

class RfidTagSetPlugin : public ModelPlugin {
 public:
  RfidTagSetPlugin() = default;
  ~RfidTagSetPlugin() override;
  RfidTagSetPlugin(const RfidTagSetPlugin&) = delete;
  RfidTagSetPlugin& operator=(const RfidTagSetPlugin&) = delete;
  void Load(physics::ModelPtr model, sdf::ElementPtr plugin) override;

 private:
  void load(const physics::ModelPtr& model, const sdf::ElementPtr& plugin);

  std::shared_ptr<tagfield::RfidWorld> world_;
  tagfield::RfidWorld::Handle handle_ = 0;
};

}  // namespace gazebo
