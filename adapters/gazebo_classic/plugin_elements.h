/// @file
/// A model plugin's parameters from SDF.
#pragma once

#include <gazebo/physics/PhysicsTypes.hh>
#include <optional>
#include <sdf/sdf.hh>
#include <string>
#include <vector>

#include "tagfield/base/raw_parameter.h"

namespace tagfield {

/// The children of `parent`, which may be null, that are called `name`.
std::vector<sdf::ElementPtr> children(const sdf::ElementPtr& parent, const std::string& name);

/// The parameters in a plugin's element; those inside others (`<path><waypoint>`) stand for
/// themselves.
std::vector<RawParameter> parameters_in(const sdf::ElementPtr& plugin);

/// The parameters of the model's plugins of file `filename`, those of a later one in place of those
/// of an earlier: so a world's `<include>` adds to what the included model says. None if `own` is
/// not the first of these plugins, which speaks for all of them.
std::optional<std::vector<RawParameter>> plugin_parameters(gazebo::physics::Model& model,
                                                           const sdf::ElementPtr& own,
                                                           const std::string& filename);

/// "model 'p3at', plugin 'robot'", for messages.
std::string place_of(gazebo::physics::Model& model, const sdf::ElementPtr& plugin);

}  // namespace tagfield
