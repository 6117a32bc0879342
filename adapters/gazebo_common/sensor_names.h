// SPDX-License-Identifier: Apache-2.0
/// @file
/// Names of antennas and tags on sensors, in any version of Gazebo.
#pragma once

#include <string>
#include <vector>

#include "tagfield/field/rfid_field.h"
#include "tagfield/settings/sensor_parameters.h"

namespace tagfield {

/// A sensor, and the link and model that it is on.
struct SensorPlace {
  std::string model;  ///< Scoped name.
  std::string link;   ///< Its name in the model.
  std::string sensor;
};

/// "model 'p3at', link 'base_link', sensor 'gate'", for messages.
std::string place_of(const SensorPlace& at);

/// ID of a tag without `epc`: its model's name if it is the model's only tag, else MODEL::SENSOR,
/// or MODEL::LINK::SENSOR if that is not unique. `tags_in_model`: the names of all tag sensors of
/// the model.
std::string tag_id_of(const SensorPlace& at, const std::vector<std::string>& tags_in_model);

/// The antenna described by a sensor of this name.
FieldAntenna field_antenna(const std::string& sensor, const SensorAntenna& described);

/// Prefixes those of the antenna's names that are the sensor's with the model's.
void put_model_in_front(const std::string& model, FieldAntenna& antenna);

}  // namespace tagfield
