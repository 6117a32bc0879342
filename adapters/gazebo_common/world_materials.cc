// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_common/world_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapters/gazebo_common/sdf_elements.h"
#include "tagfield/base/number.h"
#include "tagfield/base/spelling.h"

namespace tagfield {
namespace {

/// "<made_of name="rack">", for messages.
std::string element_of(const RawParameter& parameter) { return "<" + parameter.key + ">"; }

double number_in(const RawParameter& parameter) {
  const std::optional<double> value = parse_number(parameter.value);
  if (!value || !std::isfinite(*value)) {
    throw Error(fmt::format("{} is '{}', expected a finite number", element_of(parameter),
                            parameter.value));
  }
  return *value;
}

bool truth_in(const RawParameter& parameter) {
  if (parameter.value == "true" || parameter.value == "1") return true;
  if (parameter.value == "false" || parameter.value == "0") return false;
  throw Error(
      fmt::format("{} is '{}', expected true or false", element_of(parameter), parameter.value));
}

std::string name_of(const sdf::ElementPtr& element) {
  std::string name = element->HasAttribute("name") ? element->Get<std::string>("name") : "";
  if (name.empty()) throw Error(fmt::format("<{}> has no name=\"…\"", element->GetName()));
  return name;
}

void warn_of_unknown(const std::string& name, const std::vector<std::string>& known,
                     Diagnostics& diagnostics) {
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  diagnostics.warn(fmt::format("<{}> is not known and left out{}", name, suggestion(name, known)));
}

void set_property(const RawParameter& property, Material& material, Diagnostics& diagnostics) {
  if (property.key == "permittivity") {
    material.permittivity_a = number_in(property);
  } else if (property.key == "permittivity_exponent") {
    material.permittivity_b = number_in(property);
  } else if (property.key == "conductivity_s_m") {
    material.conductivity_c = number_in(property);
  } else if (property.key == "conductivity_exponent") {
    material.conductivity_d = number_in(property);
  } else if (property.key == "wall_m") {
    material.wall_m = number_in(property);
  } else if (property.key == "crossing_db") {
    material.crossing_db = number_in(property);
  } else if (property.key == "opaque") {
    material.is_opaque = truth_in(property);
  } else {
    warn_of_unknown(property.key,
                    {"permittivity", "permittivity_exponent", "conductivity_s_m",
                     "conductivity_exponent", "wall_m", "crossing_db", "opaque"},
                    diagnostics);
  }
}

Material material_in(const sdf::ElementPtr& element, Diagnostics& diagnostics) {
  Material material;
  material.name = name_of(element);
  try {
    for (const RawParameter& property : parameters_in(element)) {
      set_property(property, material, diagnostics);
    }
    check(material);
  } catch (const Error& error) {
    throw Error(fmt::format("<material name=\"{}\">: {}", material.name, error.what()));
  }
  return material;
}

/// The world's own materials take precedence over known ones with the same name.
std::vector<Material> materials_of(const sdf::ElementPtr& plugin, Diagnostics& diagnostics) {
  std::vector<Material> materials;
  for (const sdf::ElementPtr& element : children(plugin, "material")) {
    materials.push_back(material_in(element, diagnostics));
  }
  const std::vector<Material>& known = known_materials();
  materials.insert(materials.end(), known.begin(), known.end());
  return materials;
}

MaterialRule rule_in(const sdf::ElementPtr& element, const std::vector<Material>& materials) {
  const std::string name = name_of(element);
  try {
    return {name, find_material(materials, element->Get<std::string>()), {}};
  } catch (const Error& error) {
    throw Error(fmt::format("<made_of name=\"{}\">: {}", name, error.what()));
  }
}

}  // namespace

RadioWorldOptions materials_in(const sdf::ElementPtr& plugin, Diagnostics& diagnostics) {
  RadioWorldOptions options;
  options.materials = materials_of(plugin, diagnostics);
  for (sdf::ElementPtr child = plugin->GetFirstElement(); child; child = child->GetNextElement()) {
    const std::string key = child->GetName();
    const sdf::ParamPtr value = child->GetValue();
    const RawParameter parameter{key, value ? value->GetAsString() : "", {}};
    if (key == "made_of") {
      options.rules.push_back(rule_in(child, options.materials));
    } else if (key == "default_material") {
      options.otherwise = find_material(options.materials, parameter.value).name;
      options.states_otherwise = true;
    } else if (key == "min_facet_m2") {
      options.min_facet_m2 = number_in(parameter);
    } else {
      warn_of_unknown(key, {"made_of", "default_material", "min_facet_m2", "material"},
                      diagnostics);
    }
  }
  if (options.min_facet_m2 < 0.0) throw Error("<min_facet_m2> must be 0 or more");
  return options;
}

}  // namespace tagfield
