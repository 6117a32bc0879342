// SPDX-License-Identifier: Apache-2.0
/// @file
/// Names and parameters of a sensor plugin.
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

/// The plugin's parameters, and the sensor's <update_rate> if it has one.
std::vector<RawParameter> parameters_of(const sdf::ElementPtr& plugin);

/// Scoped name of the sensor's model.
std::string model_name_of(const gazebo::sensors::Sensor& sensor);

/// ID of a tag without an EPC, as in headless runs: its model's name if it is the model's only tag,
/// else MODEL::SENSOR, or MODEL::LINK::SENSOR if that is not unique. To be called once the link's
/// model is complete.
std::string tag_id_of(const std::string& sensor, gazebo::physics::Link& link);

/// Name of a tag in the published plugin: MODEL::LINK, followed by ::SENSOR if the link has
/// several.
std::string published_name_of(const std::string& sensor, gazebo::physics::Link& link);

}  // namespace tagfield
