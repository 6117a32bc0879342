// SPDX-License-Identifier: Apache-2.0
/// @file
/// A model plugin's parameters from SDF.
#pragma once

#include <gazebo/physics/PhysicsTypes.hh>
#include <optional>
#include <string>
#include <vector>

#include "adapters/gazebo_common/sdf_elements.h"

namespace tagfield {

/// The parameters of the model's plugins of file `filename`, those of a later one in place of those
/// of an earlier: so a world's `<include>` adds to what the included model says. None if `own` is
/// not the first of these plugins, which speaks for all of them.
std::optional<std::vector<RawParameter>> plugin_parameters(gazebo::physics::Model& model,
                                                           const sdf::ElementPtr& own,
                                                           const std::string& filename);

/// "model 'p3at', plugin 'robot'", for messages.
std::string place_of(gazebo::physics::Model& model, const sdf::ElementPtr& plugin);

}  // namespace tagfield
