// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where a sensor plugin stands: its names and parameters.
#pragma once

#include <gazebo/physics/PhysicsTypes.hh>
#include <gazebo/sensors/SensorTypes.hh>
#include <sdf/sdf.hh>
#include <string>
#include <vector>

#include "tagfield/base/setting.h"

namespace tagfield {

/// "model 'gate', link 'post', sensor 'antenna'", for messages.
std::string place_of(const gazebo::sensors::Sensor& sensor);

/// The plugin's parameters, and the sensor's <update_rate> where it has one.
std::vector<RawParameter> parameters_of(const sdf::ElementPtr& plugin);

/// Scoped name of the sensor's model.
std::string model_name_of(const gazebo::sensors::Sensor& sensor);

/// A tag's ID where it has no EPC: its model's name where it is the model's only tag, else
/// MODEL::SENSOR, else MODEL::LINK::SENSOR where that is not unique. The same as headless. To be
/// called when the link's model is whole.
std::string tag_id_of(const std::string& sensor, gazebo::physics::Link& link);

/// What the published plugin calls a tag: MODEL::LINK; with ::SENSOR where the link has several.
std::string published_name_of(const std::string& sensor, gazebo::physics::Link& link);

}  // namespace tagfield
