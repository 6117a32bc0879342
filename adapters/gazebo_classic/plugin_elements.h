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

/// The parameters of all of the model's plugins with file `filename`; those of a later plugin
/// override those of an earlier one, so a world's `<include>` can extend an included model. None if
/// `own` is not the first of these plugins, as the first one acts for all of them.
std::optional<std::vector<RawParameter>> plugin_parameters(gazebo::physics::Model& model,
                                                           const sdf::ElementPtr& own,
                                                           const std::string& filename);

/// "model 'p3at', plugin 'robot'", for messages.
std::string place_of(gazebo::physics::Model& model, const sdf::ElementPtr& plugin);

}  // namespace tagfield
