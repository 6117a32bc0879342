// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_world/internal/radio.h"

#include <algorithm>
#include <cstring>

#include "tagfield/field/antenna_facts.h"

namespace tagfield::gazebo_world_internal {
namespace {

constexpr const char* kMaterialsPlugin = "libTagfieldMaterialsPlugin.so";

void drop_materials(XMLElement* world) {
  XMLElement* next = nullptr;
  for (XMLElement* plugin = world->FirstChildElement("plugin"); plugin != nullptr; plugin = next) {
    next = plugin->NextSiblingElement("plugin");
    const char* const file = plugin->Attribute("filename");
    if (file != nullptr && std::strstr(file, kMaterialsPlugin) != nullptr) {
      world->DeleteChild(plugin);
    }
  }
}

void add_material(XMLElement* plugin, const Material& material) {
  XMLElement* const element = add_named(plugin, "material", material.name);
  add(element, "permittivity", material.permittivity_a);
  add(element, "permittivity_exponent", material.permittivity_b);
  add(element, "conductivity_s_m", material.conductivity_c);
  add(element, "conductivity_exponent", material.conductivity_d);
  if (material.wall_m) add(element, "wall_m", *material.wall_m);
  if (material.crossing_db) add(element, "crossing_db", *material.crossing_db);
  add(element, "opaque", std::string(material.is_opaque ? "true" : "false"));
}

/// Adds the materials that precede the known ones.
void add_own_materials(XMLElement* plugin, const std::vector<Material>& materials) {
  const std::size_t known = std::min(known_materials().size(), materials.size());
  for (std::size_t i = 0; i < materials.size() - known; ++i) {
    require_xml_text(materials[i].name, "material", {});
    add_material(plugin, materials[i]);
  }
}

}  // namespace

void add_settings(XMLElement* plugin, const std::vector<RawParameter>& settings) {
  for (const RawParameter& setting : settings) {
    if (setting.value.empty()) continue;  // An empty list, which SDF can't express.
    require_xml_text(setting.value, setting.key.c_str(), setting.location);
    add(plugin, setting.key.c_str(), setting.value);
  }
}

void add_materials(const Scenario& scenario, XMLElement* world) {
  const bool is_of_use =
      std::any_of(scenario.antennas.begin(), scenario.antennas.end(),
                  [](const AntennaSpec& antenna) { return meets_world(antenna.parameters); });
  if (!is_of_use) return;
  drop_materials(world);
  const RadioWorldOptions& options = scenario.materials;
  XMLElement* const plugin = add_plugin(world, kMaterialsPlugin);
  add_own_materials(plugin, options.materials);
  for (const MaterialRule& rule : options.rules) {
    require_xml_text(rule.name, "name under world.materials", rule.location);
    XMLElement* const element = add(plugin, "made_of", rule.material.name);
    element->SetAttribute("name", rule.name.c_str());
  }
  if (options.states_otherwise) add(plugin, "default_material", options.otherwise);
  add(plugin, "min_facet_m2", options.min_facet_m2);
}

}  // namespace tagfield::gazebo_world_internal
