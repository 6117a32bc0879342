// SPDX-License-Identifier: Apache-2.0
/// @file
/// libTagfieldMaterialsPlugin.so: what a world is made of, for antennas with physical models.
///
///     <world name="default">
///       <plugin name="materials" filename="libTagfieldMaterialsPlugin.so">
///         <!-- A model, a link or a collision by its scoped name, or all that wear a visual's
///              material of that name; * stands for any characters; the last that fits counts -->
///         <made_of name="rack*">metal</made_of>
///         <made_of name="office::link::door">my_foam</made_of>
///         <default_material>concrete</default_material> <!-- where no rule fits and no name tells;
///                                                            concrete -->
///         <least_facet_m2>0.1</least_facet_m2> <!-- m²; smaller flat pieces don't mirror; 0.1 -->
///         <material name="my_foam">            <!-- besides those of tagfield/channel/material.h
///         -->
///           <permittivity>1.2</permittivity>   <!-- relative, at f GHz: this · f^exponent; 1 -->
///           <permittivity_exponent>0</permittivity_exponent>    <!-- 0 -->
///           <conductivity_s_m>0.01</conductivity_s_m>           <!-- likewise, S/m; 0 -->
///           <conductivity_exponent>0</conductivity_exponent>    <!-- 0 -->
///           <wall_m>0.004</wall_m>             <!-- m; thickness of hollow things' walls; solid
///           --> <crossing_db>3</crossing_db>       <!-- dB; loss of each crossing; computed -->
///           <opaque>false</opaque>             <!-- whether nothing passes; false -->
///         </material>
///       </plugin>
///     </world>
///
/// One a world. What is wrong is one error that names plugin and element; materials are then as
/// without the plugin: guessed from names.
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
