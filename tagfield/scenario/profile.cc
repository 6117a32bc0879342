// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "tagfield/base/spelling.h"
#include "tagfield/scenario/internal/radio_yaml.h"
#include "tagfield/scenario/yaml_map.h"
#include "tagfield/scenario/yaml_values.h"
#include "tagfield/settings/radio_settings.h"

namespace tagfield {
namespace fs = std::filesystem;
namespace {

const char* folder_of(ProfileKind kind) {
  constexpr const char* kFolders[] = {"readers", "antennas", "tags"};
  return kFolders[static_cast<int>(kind)];
}

/// Next to the installed program, in the source tree, or where the libraries were installed.
fs::path profiles_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  fs::path beside = program.parent_path().parent_path() / "share/tagfield/profiles";
  if (fs::is_directory(beside, error)) return beside;
  for (fs::path place : {TAGFIELD_PROFILES, TAGFIELD_INSTALLED_PROFILES}) {
    if (fs::is_directory(place, error)) return place;
  }
  return "/usr/share/tagfield/profiles";  // As installed by a package.
}

std::vector<std::string> keys_of(ProfileKind kind) {
  std::vector<std::string> keys;
  const auto& settings = kind == ProfileKind::kTag ? tag_settings() : antenna_settings();
  keys.reserve(settings.size());
  for (const SettingHelp& setting : settings) keys.push_back(setting.key);
  return keys;
}

RawParameter figure_of(const std::string& key, YamlMap map) {
  RawParameter parameter = raw_parameter(key, map.at("value"));
  parameter.in_profile = true;
  static_cast<void>(map.at("source").text());
  map.finish();
  return parameter;
}

void read_figures(const YamlValue& figures, Profile& profile) {
  const std::vector<std::string> known = keys_of(profile.kind);
  YamlMap map(figures);
  for (const auto& entry : figures.node()) {
    const auto key = entry.first.as<std::string>();
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      map.at(key).fail(
          fmt::format("is not a setting of a profile of this kind{}", suggestion(key, known)));
    }
    profile.parameters.push_back(figure_of(key, YamlMap(map.at(key))));
  }
}

}  // namespace

Profile read_profile(const std::string& path) {
  const YAML::Node root = read_yaml(path);
  YamlMap map(YamlValue(root, path, ""));
  Profile profile;
  profile.name = map.at("name").text();
  constexpr ProfileKind kKinds[] = {ProfileKind::kReader, ProfileKind::kAntenna, ProfileKind::kTag};
  profile.kind = kKinds[choice(map.at("kind"), {"reader", "antenna", "tag"})];
  map.text("description", "");
  read_figures(map.at("figures"), profile);
  map.finish();
  return profile;
}

std::vector<std::string> shipped_profiles(ProfileKind kind) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(profiles_folder() / folder_of(kind), error)) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string shipped_profile(const std::string& name, const std::vector<ProfileKind>& kinds) {
  const bool is_plain =
      name.find_first_of("/\\") == std::string::npos && name != "." && name != "..";
  if (!is_plain) return "";
  std::error_code error;
  for (const ProfileKind kind : kinds) {
    const fs::path file = profiles_folder() / folder_of(kind) / (name + ".yaml");
    if (fs::is_regular_file(file, error)) return file.string();
  }
  return "";
}

}  // namespace tagfield
