#include "tagfield/sdf/internal/sensors.h"

#include <array>
#include <map>
#include <utility>

#include "tagfield/base/range_check.h"
#include "tagfield/sdf/internal/poses.h"

namespace tagfield::sdf_internal {
namespace {

std::string trimmed(const std::string& text) {
  const char* const spaces = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(spaces);
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(spaces) - begin + 1);
}

std::string text_of(const sdf::ElementPtr& element) {
  return element->GetValue() ? trimmed(element->GetValue()->GetAsString()) : "";
}

void add_plugin_parameters(Context& context, const sdf::ElementPtr& plugin,
                           std::vector<RawParameter>& parameters) {
  Location location = location_of(context, plugin);
  const std::vector<int> lines =
      child_lines(outline_of(context, plugin->FilePath()), "plugin", location.line);
  std::size_t index = 0;
  for (auto child = plugin->GetFirstElement(); child; child = child->GetNextElement()) {
    if (index < lines.size()) location.line = lines[index++];
    parameters.push_back({child->GetName(), text_of(child), location});
  }
}

std::vector<RawParameter> parameters_of(Context& context, const sdf::ElementPtr& sensor) {
  std::vector<RawParameter> parameters;
  const sdf::ElementPtr plugin = written_child(sensor, "plugin");
  if (plugin) add_plugin_parameters(context, plugin, parameters);
  const sdf::ElementPtr rate = written_child(sensor, "update_rate");
  if (rate) parameters.push_back({"update_rate", text_of(rate), location_of(context, rate)});
  return parameters;
}

using Scope = std::string (*)(const NamedPlacement&);

std::string sensor_name(const NamedPlacement& s) { return s.placement.name; }
std::string model_name(const NamedPlacement& s) { return s.model; }
std::string model_and_sensor(const NamedPlacement& s) { return s.model + "::" + s.placement.name; }
std::string whole_name(const NamedPlacement& s) {
  return s.model + "::" + s.link + "::" + s.placement.name;
}

/// The first of these that no other sensor has is a sensor's name.
std::array<Scope, 3> scopes(SensorKind kind) {
  return {kind == SensorKind::kTag ? model_name : sensor_name, model_and_sensor, whole_name};
}

}  // namespace

NamedPlacement read_sensor(Context& context, const sdf::Sensor& sensor, const RigidTransform& X_WL,
                           const std::string& model, const std::string& link) {
  const sdf::ElementPtr element = sensor.Element();
  const RigidTransform X_WS = X_WL * pose_in_parent(context, sensor.SemanticPose(), element);
  if (X_WS.translation.cwiseAbs().maxCoeff() > kMostLength_m) {
    fail(location_of(context, element),
         "sensor '" + sensor.Name() + "' stands over 100 km from the origin");
  }
  return {{sensor.Name(), X_WS, parameters_of(context, element), location_of(context, element)},
          model,
          link};
}

std::vector<Placement> with_unique_names(const std::vector<NamedPlacement>& sensors,
                                         SensorKind kind) {
  std::map<std::string, int> uses;
  for (const Scope scope : scopes(kind)) {
    for (const NamedPlacement& sensor : sensors) ++uses[scope(sensor)];
  }
  std::vector<Placement> placements;
  for (const NamedPlacement& sensor : sensors) {
    placements.push_back(sensor.placement);
    for (const Scope scope : scopes(kind)) {
      placements.back().name = scope(sensor);
      if (uses[placements.back().name] == 1) break;
    }
  }
  return placements;
}

}  // namespace tagfield::sdf_internal
