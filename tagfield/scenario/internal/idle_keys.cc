// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/internal/idle_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <string_view>

#include "tagfield/reader/radio_model.h"
#include "tagfield/settings/idle_settings.h"

namespace tagfield {
namespace {

void warn(const YamlValue& value, std::string_view why, Diagnostics& diagnostics) {
  diagnostics.warn(value.location(), fmt::format("{} has no effect {}", value.path(), why));
}

/// Whether the number under `key` is given and greater than 0.
bool says_more_than_zero(YamlMap& map, const char* key) {
  return map.has(key) && map.at(key).number() > 0.0;
}

bool any_on_a_robot(const Scenario& scenario) {
  return std::any_of(scenario.antennas.begin(), scenario.antennas.end(),
                     [](const AntennaSpec& antenna) { return !antenna.on.empty(); });
}

/// Warns about a pose belief that applies to no antenna.
void warn_of_unused_belief(YamlMap& map, const Scenario& scenario, Diagnostics& diagnostics) {
  const PoseSource source = scenario.pose.source;
  const bool is_for_robots = source == PoseSource::kNoisy || source == PoseSource::kOdometry;
  if (!is_for_robots || any_on_a_robot(scenario)) return;
  warn(map.at(map.has("pose") ? "pose" : "navigation"),
       "on reads: no antenna is on a robot, and poses of fixed and recorded ones are known exactly",
       diagnostics);
}

/// The value that selects the source of poses; none if there is none.
std::optional<YamlValue> switch_of(YamlMap& map) {
  if (map.has("navigation")) {
    const YamlValue navigation = map.at("navigation");
    if (!navigation.node().IsMap()) return navigation;
    YamlMap inside(navigation);
    return inside.has("mode") ? inside.at("mode") : navigation;
  }
  if (!map.has("pose")) return std::nullopt;
  YamlMap pose(map.at("pose"));
  return pose.has("source") ? std::optional<YamlValue>(pose.at("source")) : std::nullopt;
}

/// Whether the value is from the scenario's file, not the command line.
bool is_in_file(const YamlValue& value) { return value.location().file == value.file(); }

/// Warns about keys that are not used with this source, except those of a file whose source was
/// overridden from the command line: that is a user trying out another source.
void warn_beside(const std::optional<YamlValue>& source, YamlMap map,
                 std::initializer_list<const char*> keys, std::string_view why,
                 Diagnostics& diagnostics) {
  for (const char* const key : keys) {
    if (!map.has(key)) continue;
    const YamlValue value = map.at(key);
    if (source && !is_in_file(*source) && is_in_file(value)) continue;
    warn(value, why, diagnostics);
  }
}

void warn_of_pose(YamlMap map, PoseSource source, const std::optional<YamlValue>& of_source,
                  Diagnostics& diagnostics) {
  const auto why = [&](PoseSource expected) {
    return fmt::format("with source: {}; expected source: {}", to_string(source),
                       to_string(expected));
  };
  if (source != PoseSource::kNoisy) {
    for (const char* const key : {"sigma_m", "yaw_sigma_deg"}) {
      if (!says_more_than_zero(map, key)) continue;
      warn_beside(of_source, map, {key}, why(PoseSource::kNoisy), diagnostics);
    }
    warn_beside(of_source, map, {"time_constant_s"}, why(PoseSource::kNoisy), diagnostics);
  }
  if (source != PoseSource::kOdometry) {
    warn_beside(of_source, map, {"wheel_noise"}, why(PoseSource::kOdometry), diagnostics);
  }
}

/// The first robot with waypoints or goals navigates.
void warn_of_navigating_robot(YamlMap& map, const Scenario& scenario,
                              const std::optional<YamlValue>& of_source, Diagnostics& diagnostics) {
  const auto navigates = std::find_if(scenario.robots.begin(), scenario.robots.end(), drives);
  if (navigates == scenario.robots.end()) return;
  const auto number = static_cast<std::size_t>(navigates - scenario.robots.begin());
  warn_beside(of_source, YamlMap(map.list("robots")[number]), {"max_turn_rad_s", "look_ahead_m"},
              "with navigation: slam, whose paths navigation.driving describes", diagnostics);
}

void warn_of_navigation(YamlMap map, Diagnostics& diagnostics) {
  if (!map.has("map")) {
    if (map.has("map_sigma_m")) warn(map.at("map_sigma_m"), "without a given map", diagnostics);
    return;
  }
  if (map.has("mapping")) warn(map.at("mapping"), "with a given map", diagnostics);
}

/// Waves pass through an obstacle without a material; only robots, with their lasers, notice it.
void warn_of_obstacle(const YamlValue& value, const Scenario& scenario, Diagnostics& diagnostics) {
  YamlMap map(value);
  if (!map.has("material") && scenario.robots.empty()) {
    warn(value, "on reads: it has no material, and there is no robot that could notice it",
         diagnostics);
  }
  if (map.has("radius_m") && map.number("yaw", 0.0) != 0.0) {
    warn(map.at("yaw"), "on a round obstacle", diagnostics);
  }
}

void warn_of_pose_error(YamlMap map, Diagnostics& diagnostics) {
  if (!map.has("time_constant_s")) return;
  if (says_more_than_zero(map, "sigma_m") || says_more_than_zero(map, "yaw_sigma_deg")) return;
  warn(map.at("time_constant_s"), "without a sigma_m or a yaw_sigma_deg", diagnostics);
}

bool is_mapping(YamlMap& map, const char* key) {
  return map.has(key) && map.at(key).node().IsMap();
}

void add(YamlMap map, std::initializer_list<const char*> keys, std::vector<PlacedKey>& all) {
  for (const char* const key : keys) {
    if (!map.has(key)) continue;
    const YamlValue value = map.at(key);
    all.push_back({value.location(), value.path()});
  }
}

/// Whether the setting was given for all antennas of the scenario and another one uses it.
bool is_used_by_another(const Scenario& scenario, const RawParameter& setting) {
  const bool is_for_all = setting.key == "diffraction" || setting.key == "interference" ||
                          setting.key == "tag_coupling";
  const auto is_the_same = [&](const RawParameter& other) {
    return other.key == setting.key && to_string(other.location) == to_string(setting.location);
  };
  const auto uses_it = [&](const AntennaSpec& antenna) {
    const RadioModel* const model = physical(antenna.parameters);
    return model != nullptr && !why_idle(setting.key, *model) &&
           std::any_of(model->settings.begin(), model->settings.end(), is_the_same);
  };
  return is_for_all && std::any_of(scenario.antennas.begin(), scenario.antennas.end(), uses_it);
}

template <class Model>
void warn_of_settings_of(const Model& model, const std::string& whose, const Scenario& scenario,
                         Diagnostics& diagnostics) {
  for (const RawParameter& setting : model.settings) {
    if (!is_own(setting) || is_used_by_another(scenario, setting)) continue;
    const auto why = why_idle(setting.key, model);
    if (!why) continue;
    diagnostics.warn(setting.location,
                     fmt::format("{} of {} has no effect {}", setting.key, whose, *why));
  }
}

bool reflects(const AntennaSpec& antenna) {
  const RadioModel* const model = physical(antenna.parameters);
  return model != nullptr && model->effects.reflections && model->reflection_order > 0;
}

}  // namespace

bool is_own(const RawParameter& setting) {
  return !setting.in_profile && !setting.location.file.empty();
}

void warn_of_idle_keys(YamlMap& map, const Scenario& scenario, Diagnostics& diagnostics) {
  warn_of_unused_belief(map, scenario, diagnostics);
  const std::optional<YamlValue> of_source = switch_of(map);
  if (map.has("pose")) {
    warn_of_pose(YamlMap(map.at("pose")), scenario.pose.source, of_source, diagnostics);
  }
  if (scenario.pose.source == PoseSource::kSlam) {
    warn_of_navigating_robot(map, scenario, of_source, diagnostics);
  }
  if (is_mapping(map, "navigation")) warn_of_navigation(YamlMap(map.at("navigation")), diagnostics);
  for (const YamlValue& obstacle : map.list("obstacles")) {
    warn_of_obstacle(obstacle, scenario, diagnostics);
  }
  if (!is_mapping(map, "localization")) return;
  YamlMap localization(map.at("localization"));
  if (is_mapping(localization, "pose_error")) {
    warn_of_pose_error(YamlMap(localization.at("pose_error")), diagnostics);
  }
}

std::vector<PlacedKey> keys_of_physical_models(YamlMap& map) {
  std::vector<PlacedKey> all;
  add(map, {"materials"}, all);
  if (is_mapping(map, "world")) {
    add(YamlMap(map.at("world")), {"materials", "default_material", "min_facet_m2"}, all);
  }
  for (const YamlValue& robot : map.list("robots")) add(YamlMap(robot), {"body"}, all);
  for (const YamlValue& obstacle : map.list("obstacles")) add(YamlMap(obstacle), {"material"}, all);
  for (const YamlValue& tag : map.list("tags")) add(YamlMap(tag), {"rpy"}, all);
  return all;
}

void warn_of_idle_settings(const Scenario& scenario,
                           const std::vector<PlacedKey>& of_physical_models,
                           Diagnostics& diagnostics) {
  const auto is_physical = [](const AntennaSpec& antenna) {
    return physical(antenna.parameters) != nullptr;
  };
  const bool any_physical =
      std::any_of(scenario.antennas.begin(), scenario.antennas.end(), is_physical);
  const bool any_reflects =
      std::any_of(scenario.antennas.begin(), scenario.antennas.end(), reflects);
  for (const PlacedKey& key : of_physical_models) {
    if (!any_physical) {
      diagnostics.warn(key.location,
                       fmt::format("{} has no effect with model: paper; expected model: "
                                   "link_budget or multipath",
                                   key.path));
    } else if (key.path == "world.min_facet_m2" && !any_reflects) {
      diagnostics.warn(key.location,
                       fmt::format("{} has no effect without an antenna with reflections (model: "
                                   "multipath)",
                                   key.path));
    }
  }
  for (const AntennaSpec& antenna : scenario.antennas) {
    if (!is_physical(antenna)) continue;
    warn_of_settings_of(*physical(antenna.parameters),
                        fmt::format("antenna '{}'", antenna.parameters.name), scenario,
                        diagnostics);
  }
  for (const TagSpec& tag : scenario.tags) {
    if (tag.model) {
      warn_of_settings_of(*tag.model, fmt::format("tag '{}'", tag.id), scenario, diagnostics);
    }
  }
}

void warn_of_idle_settings(const RadioModel& antenna, const std::string& whose,
                           Diagnostics& diagnostics) {
  warn_of_settings_of(antenna, whose, {}, diagnostics);
}

void warn_of_idle_settings(const TagModel& tag, const std::string& whose,
                           Diagnostics& diagnostics) {
  warn_of_settings_of(tag, whose, {}, diagnostics);
}

}  // namespace tagfield
