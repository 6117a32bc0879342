// SPDX-License-Identifier: Apache-2.0
/// @file
/// libTagfieldMaterialsPlugin.so: the materials of a world, for antennas with physical models.
///
///     <world name="default">
///       <plugin name="materials" filename="libTagfieldMaterialsPlugin.so">
///         <!-- The scoped name of a model, link or collision, or the name of a visual's
///              material; * stands for any characters; the last match counts -->
///         <made_of name="rack*">metal</made_of>
///         <made_of name="office::link::door">my_foam</made_of>
///         <default_material>concrete</default_material> <!-- where neither a rule nor a name
///                                                            decides; concrete -->
///         <min_facet_m2>0.1</min_facet_m2> <!-- m²; smaller facets don't reflect; 0.1 -->
///         <material name="my_foam">            <!-- besides those of channel/material.h -->
///           <permittivity>1.2</permittivity>   <!-- relative, at f GHz: this · f^exponent; 1 -->
///           <permittivity_exponent>0</permittivity_exponent>    <!-- 0 -->
///           <conductivity_s_m>0.01</conductivity_s_m>           <!-- S/m, as above; 0 -->
///           <conductivity_exponent>0</conductivity_exponent>    <!-- 0 -->
///           <wall_m>0.004</wall_m>             <!-- m; wall thickness if hollow; solid -->
///           <crossing_db>3</crossing_db>       <!-- dB; loss per crossing; computed -->
///           <opaque>false</opaque>             <!-- whether it blocks all waves; false -->
///         </material>
///       </plugin>
///     </world>
///
/// At most one per world. Invalid input causes one error that names plugin and element; materials
/// are then guessed from names, as without the plugin.
#pragma once

#include <gazebo/common/Plugin.hh>
#include <memory>

#include "adapters/gazebo_classic/rfid_world.h"

namespace gazebo {

class TagfieldMaterialsPlugin : public WorldPlugin {
 public:
  void Load(physics::WorldPtr world, sdf::ElementPtr plugin) override;

 private:
  std::shared_ptr<tagfield::RfidWorld> world_;
};

}  // namespace gazebo
