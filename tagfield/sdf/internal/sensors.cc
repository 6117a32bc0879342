// SPDX-License-Identifier: Apache-2.0
#include "tagfield/sdf/internal/sensors.h"

#include <array>
#include <map>
#include <sstream>
#include <utility>

#include "tagfield/base/range_check.h"

namespace tagfield::sdf_internal {
namespace {

using tinyxml2::XMLElement;

/// The text with single spaces between words.
std::string words_of(const XMLElement& element) {
  std::istringstream text(text_of(element));
  std::string words;
  for (std::string word; text >> word;) words += (words.empty() ? "" : " ") + word;
  return words;
}

std::vector<RawParameter> parameters_of(const XMLElement& sensor) {
  std::vector<RawParameter> parameters;
  if (const XMLElement* plugin = sensor.FirstChildElement("plugin")) {
    for_each_child(*plugin, [&](const XMLElement& child) {
      parameters.push_back({child.Name(), words_of(child), location_of(child)});
    });
  }
  if (const XMLElement* rate = sensor.FirstChildElement("update_rate")) {
    parameters.push_back({"update_rate", words_of(*rate), location_of(*rate)});
  }
  return parameters;
}

using NameOf = std::string (*)(const NamedPlacement&);

std::string sensor_name(const NamedPlacement& s) { return s.placement.name; }
std::string model_name(const NamedPlacement& s) { return s.model; }
std::string model_and_sensor(const NamedPlacement& s) { return s.model + "::" + s.placement.name; }
std::string whole_name(const NamedPlacement& s) {
  return s.model + "::" + s.link + "::" + s.placement.name;
}

/// A sensor gets the first of these names that no other sensor has.
std::array<NameOf, 3> scopes(SensorKind kind) {
  return {kind == SensorKind::kTag ? model_name : sensor_name, model_and_sensor, whole_name};
}

}  // namespace

NamedPlacement read_sensor(const XMLElement& sensor, const RigidTransform& X_WS,
                           const std::string& model, const std::string& link) {
  const std::string name = name_of(sensor);
  if (X_WS.translation.cwiseAbs().maxCoeff() > kMaxLength_m) {
    fail(location_of(sensor), "sensor '" + name + "' stands over 100 km from the origin");
  }
  return {{name, X_WS, parameters_of(sensor), location_of(sensor)}, model, link};
}

std::vector<Placement> with_unique_names(const std::vector<NamedPlacement>& sensors,
                                         SensorKind kind) {
  std::map<std::string, int> uses;
  for (const NameOf scope : scopes(kind)) {
    for (const NamedPlacement& sensor : sensors) ++uses[scope(sensor)];
  }
  std::vector<Placement> placements;
  for (const NamedPlacement& sensor : sensors) {
    placements.push_back(sensor.placement);
    for (const NameOf scope : scopes(kind)) {
      placements.back().name = scope(sensor);
      if (uses[placements.back().name] == 1) break;
    }
  }
  return placements;
}

}  // namespace tagfield::sdf_internal
