// SPDX-License-Identifier: Apache-2.0
/// @file
/// What antennas and tags on sensors are called, in any Gazebo.
#pragma once

#include <string>
#include <vector>

#include "tagfield/field/rfid_field.h"
#include "tagfield/settings/sensor_parameters.h"

namespace tagfield {

/// A sensor and what it is on.
struct SensorPlace {
  std::string model;  ///< Scoped name.
  std::string link;   ///< Its name in the model.
  std::string sensor;
};

/// "model 'p3at', link 'base_link', sensor 'gate'", for messages.
std::string place_of(const SensorPlace& at);

/// The ID of a tag that has no `epc`: its model's name where it is the model's only tag, else
/// MODEL::SENSOR, or MODEL::LINK::SENSOR where that is not unique. `tags_in_model`: the names of
/// all tag sensors of the model.
std::string tag_id_of(const SensorPlace& at, const std::vector<std::string>& tags_in_model);

/// The antenna that a sensor of this name describes.
FieldAntenna field_antenna(const std::string& sensor, const SensorAntenna& described);

/// Names that were the sensor's get the model's in front.
void put_model_in_front(const std::string& model, FieldAntenna& antenna);

}  // namespace tagfield
