// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_common/sensor_names.h"

#include <fmt/format.h>

#include <algorithm>

namespace tagfield {

std::string place_of(const SensorPlace& at) {
  return fmt::format("model '{}', link '{}', sensor '{}'", at.model, at.link, at.sensor);
}

std::string tag_id_of(const SensorPlace& at, const std::vector<std::string>& tags_in_model) {
  if (tags_in_model.size() <= 1) return at.model;
  if (std::count(tags_in_model.begin(), tags_in_model.end(), at.sensor) == 1) {
    return fmt::format("{}::{}", at.model, at.sensor);
  }
  return fmt::format("{}::{}::{}", at.model, at.link, at.sensor);
}

FieldAntenna field_antenna(const std::string& sensor, const SensorAntenna& described) {
  FieldAntenna antenna;
  antenna.parameters = described.parameters;
  antenna.seed = described.seed;
  antenna.sensor = sensor;
  antenna.name_space = described.name_space;
  antenna.frame_id = described.frame_id;
  antenna.parent_frame = described.parent_frame;
  return antenna;
}

void put_model_in_front(const std::string& model, FieldAntenna& antenna) {
  const std::string name = fmt::format("{}::{}", model, antenna.sensor);
  if (antenna.parameters.reader == antenna.sensor) antenna.parameters.reader = name;
  if (antenna.frame_id == antenna.sensor) antenna.frame_id = name;
  antenna.parameters.name = name;
}

}  // namespace tagfield
