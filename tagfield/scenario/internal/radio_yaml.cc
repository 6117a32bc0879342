// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/internal/radio_yaml.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tagfield/base/file_kind.h"
#include "tagfield/base/spelling.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/scenario/profile.h"
#include "tagfield/scenario/yaml_values.h"

namespace tagfield {
namespace {

/// A file, or the name of a shipped profile. A file of that name takes precedence.
std::string profile_file(const YamlValue& value, const std::vector<ProfileKind>& kinds) {
  std::string path = resolve_path(value);
  if (is_file(path)) return path;
  std::string shipped = shipped_profile(value.text(), kinds);
  if (!shipped.empty()) return shipped;
  std::vector<std::string> known;
  for (const ProfileKind kind : kinds) {
    for (const std::string& name : shipped_profiles(kind)) known.push_back(name);
  }
  value.fail(fmt::format("is '{}': there is no such file, and no such profile is shipped{}", path,
                         suggestion(value.text(), known)));
}

void append_profile(const YamlValue& file, std::vector<ProfileKind> kinds,
                    std::vector<RawParameter>& parameters) {
  const std::string path = profile_file(file, kinds);
  const Profile profile = read_profile(path);
  if (std::find(kinds.begin(), kinds.end(), profile.kind) == kinds.end()) {
    file.fail(
        fmt::format("is a {} profile, expected {}",
                    profile.kind == ProfileKind::kTag ? "tag" : "reader or antenna",
                    kinds.front() == ProfileKind::kTag ? "a tag's" : "a reader's or an antenna's"));
  }
  parameters.insert(parameters.end(), profile.parameters.begin(), profile.parameters.end());
}

void append_settings(YamlMap& map, const std::vector<SettingHelp>& settings,
                     std::vector<RawParameter>& parameters) {
  for (const SettingHelp& setting : settings) {
    if (map.has(setting.key)) parameters.push_back(raw_parameter(setting.key, map.at(setting.key)));
  }
}

Material material_of(YamlMap map) {
  Material material;
  material.name = map.at("name").text();
  material.permittivity_a = map.number("permittivity", 1.0);
  material.permittivity_b = map.number("permittivity_exponent", 0.0);
  material.conductivity_c = map.number("conductivity_s_m", 0.0);
  material.conductivity_d = map.number("conductivity_exponent", 0.0);
  if (map.has("wall_m")) material.wall_m = map.at("wall_m").number();
  if (map.has("crossing_db")) material.crossing_db = map.at("crossing_db").number();
  material.is_opaque = map.boolean("opaque", false);
  map.finish();
  try {
    check(material);
  } catch (const Error& error) {
    map.self().fail(fmt::format("('{}'): {}", material.name, error.what()));
  }
  return material;
}

/// The scenario's own override the known ones of the same name.
std::vector<Material> materials_of(YamlMap& scenario) {
  std::vector<Material> materials;
  for (const YamlValue& value : scenario.list("materials")) {
    materials.push_back(material_of(YamlMap(value)));
  }
  const std::vector<Material>& known = known_materials();
  materials.insert(materials.end(), known.begin(), known.end());
  return materials;
}

const Material& material_named(const std::vector<Material>& materials, const YamlValue& name) {
  try {
    return find_material(materials, name.text());
  } catch (const Error& error) {
    name.fail(error.what());
  }
}

}  // namespace

RawParameter raw_parameter(const std::string& key, const YamlValue& value) {
  if (!value.node().IsSequence()) return {key, value.text(), value.location()};
  std::vector<std::string> words;
  for (const YamlValue& item : value.list()) words.push_back(item.text());
  return {key, fmt::format("{}", fmt::join(words, " ")), value.location()};
}

RadioDefaults radio_defaults_of(YamlMap& map, Diagnostics& diagnostics) {
  RadioDefaults defaults;
  if (map.has("model")) {
    defaults.model = propagation_model(raw_parameter("model", map.at("model")));
  }
  if (map.has("without")) {
    defaults.without.push_back(raw_parameter("without", map.at("without")));
  }
  for (const char* const key : {"diffraction", "interference", "tag_coupling"}) {
    if (map.has(key)) defaults.antenna.push_back(raw_parameter(key, map.at(key)));
  }
  if (map.has("tag_profile")) {
    const YamlValue file = map.at("tag_profile");
    append_profile(file, {ProfileKind::kTag}, defaults.tag_parameters);
    defaults.tag_profile = file.text();
    defaults.tag =
        tag_model_from(defaults.tag_profile, defaults.tag_parameters, file.location(), diagnostics);
  }
  return defaults;
}

std::shared_ptr<const RadioModel> radio_model_of(YamlMap& antenna, PropagationModel model,
                                                 const RadioDefaults& defaults,
                                                 Diagnostics& diagnostics) {
  std::vector<RawParameter> parameters = defaults.antenna;
  for (const YamlValue& file : antenna.list("profiles")) {
    append_profile(file, {ProfileKind::kReader, ProfileKind::kAntenna}, parameters);
  }
  append_settings(antenna, antenna_settings(), parameters);
  parameters.insert(parameters.end(), defaults.without.begin(), defaults.without.end());
  return radio_model_from(model, parameters, antenna.self().location(), diagnostics);
}

std::shared_ptr<const TagModel> tag_model_of(YamlMap& tag, const RadioDefaults& defaults,
                                             Diagnostics& diagnostics) {
  std::vector<RawParameter> own;
  append_settings(tag, tag_settings(), own);
  if (own.empty() && !tag.has("profile")) return defaults.tag;
  std::vector<RawParameter> parameters = defaults.tag_parameters;
  std::string name = defaults.tag_profile;
  if (tag.has("profile")) {
    parameters.clear();
    append_profile(tag.at("profile"), {ProfileKind::kTag}, parameters);
    name = tag.at("profile").text();
  }
  parameters.insert(parameters.end(), own.begin(), own.end());
  return tag_model_from(name, parameters, tag.self().location(), diagnostics);
}

std::string profile_file_of_tag(const YamlValue& value) {
  return profile_file(value, {ProfileKind::kTag});
}

std::string profile_file_of_antenna(const YamlValue& value) {
  return profile_file(value, {ProfileKind::kReader, ProfileKind::kAntenna});
}

Material material_in(const RadioWorldOptions& options, const YamlValue& name) {
  return material_named(options.materials, name);
}

RadioWorldOptions radio_world_options_of(YamlMap& scenario) {
  RadioWorldOptions options;
  options.materials = materials_of(scenario);
  if (!scenario.has("world")) return options;
  YamlMap world(scenario.at("world"));
  options.min_facet_m2 =
      world.number("min_facet_m2", options.min_facet_m2, NumberRange::kNotNegative);
  if (world.has("default_material")) {
    options.otherwise = material_named(options.materials, world.at("default_material")).name;
    options.states_otherwise = true;
  }
  if (!world.has("materials")) return options;
  YamlMap rules(world.at("materials"));
  for (const auto& entry : rules.self().node()) {
    const auto name = entry.first.as<std::string>();
    const YamlValue value = rules.at(name);
    options.rules.push_back({name, material_named(options.materials, value), value.location()});
  }
  return options;
}

}  // namespace tagfield
