// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_classic/plugin_elements.h"

#include <fmt/format.h>

#include <algorithm>
#include <gazebo/physics/physics.hh>

namespace tagfield {
namespace {

void lay_over(std::vector<RawParameter>& below, const std::vector<RawParameter>& above) {
  const auto given_above = [&](const RawParameter& parameter) {
    return std::any_of(above.begin(), above.end(),
                       [&](const RawParameter& other) { return other.key == parameter.key; });
  };
  below.erase(std::remove_if(below.begin(), below.end(), given_above), below.end());
  below.insert(below.end(), above.begin(), above.end());
}

std::vector<sdf::ElementPtr> plugins_of(gazebo::physics::Model& model,
                                        const std::string& filename) {
  std::vector<sdf::ElementPtr> found;
  for (const sdf::ElementPtr& plugin : children(model.GetSDF(), "plugin")) {
    const auto file = plugin->Get<std::string>("filename");
    if (file.find(filename) != std::string::npos) found.push_back(plugin);
  }
  return found;
}

}  // namespace

std::optional<std::vector<RawParameter>> plugin_parameters(gazebo::physics::Model& model,
                                                           const sdf::ElementPtr& own,
                                                           const std::string& filename) {
  std::vector<sdf::ElementPtr> plugins = plugins_of(model, filename);
  if (plugins.empty()) plugins = {own};
  if (plugins.front() != own) return std::nullopt;
  std::vector<RawParameter> parameters;
  for (const sdf::ElementPtr& plugin : plugins) {
    lay_over(parameters, parameters_in(plugin));
  }
  return parameters;
}

std::string place_of(gazebo::physics::Model& model, const sdf::ElementPtr& plugin) {
  return fmt::format("model '{}', plugin '{}'", model.GetName(), plugin->Get<std::string>("name"));
}

}  // namespace tagfield
