// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/scenario_yaml.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <limits>

#include "tagfield/base/spelling.h"
#include "tagfield/base/units.h"
#include "tagfield/channel/radio_world.h"
#include "tagfield/field/antenna_facts.h"
#include "tagfield/localization/locate.h"
#include "tagfield/localization/method.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/scenario/internal/antenna_model_yaml.h"
#include "tagfield/scenario/internal/antenna_yaml.h"
#include "tagfield/scenario/internal/idle_keys.h"
#include "tagfield/scenario/internal/localization_yaml.h"
#include "tagfield/scenario/internal/navigation_yaml.h"
#include "tagfield/scenario/internal/neighbour_use.h"
#include "tagfield/scenario/internal/plan_yaml.h"
#include "tagfield/scenario/internal/robot_yaml.h"
#include "tagfield/scenario/internal/tags_yaml.h"
#include "tagfield/scenario/internal/thin_obstacles.h"
#include "tagfield/scenario/internal/zones_yaml.h"
#include "tagfield/scenario/placements.h"
#include "tagfield/scenario/plan_spec.h"
#include "tagfield/scenario/recorded_motion.h"
#include "tagfield/scenario/yaml_map.h"
#include "tagfield/scenario/yaml_values.h"

namespace tagfield {
namespace fs = std::filesystem;
namespace {

/// With `is_given`, the world has been passed along with the scenario.
WorldSpec world_of(YamlMap map, bool is_given) {
  WorldSpec world;
  if (map.has("path") == is_given) {
    map.self().fail(is_given ? "has a 'path', but the world was given: leave one of them out"
                             : "has no 'path': give the world's file with --set world.path=FILE");
  }
  if (!is_given) world.path = resolve_path(map.at("path"));
  for (const YamlValue& folder : map.list("model_paths")) {
    world.search_paths.push_back(resolve_path(folder));
  }
  world.skip_missing = map.boolean("skip_missing", world.skip_missing);
  for (const char* radio : {"materials", "default_material", "min_facet_m2"}) {
    static_cast<void>(map.has(radio));  // radio_world_options_of() reads them.
  }
  map.finish();
  return world;
}

PoseBelief belief_of(YamlMap map) {
  PoseBelief belief;
  if (map.has("source")) {
    constexpr PoseSource kSources[] = {PoseSource::kTrue, PoseSource::kNoisy, PoseSource::kOdometry,
                                       PoseSource::kSlam};
    belief.source = kSources[choice(map.at("source"), {"true", "noisy", "odometry", "slam"})];
  }
  belief.sigma_m = map.number("sigma_m", belief.sigma_m, kNotNegative);
  belief.yaw_sigma_rad = radians(map.number("yaw_sigma_deg", 0.0, kNotNegative));
  belief.time_constant_s = map.number("time_constant_s", belief.time_constant_s, kPositive);
  belief.wheel_noise = map.number("wheel_noise", belief.wheel_noise, kNotNegative);
  map.finish();
  return belief;
}

/// Requires that every tag's sensitivity is below the antennas' highest transmit power.
void require_power_for_tags(const Scenario& scenario) {
  double max_dbm = -std::numeric_limits<double>::infinity();
  for (const AntennaSpec& antenna : scenario.antennas) {
    const std::optional<double> power_dbm = transmit_power_dbm(antenna.parameters);
    if (!power_dbm) return;
    max_dbm = std::max(max_dbm, *power_dbm);
  }
  for (const TagSpec& tag : scenario.tags) {
    if (!tag.model || tag.model->sensitivity_dbm < max_dbm) continue;
    fail(tag.location, fmt::format("tag '{}': sensitivity_dbm must be below the antennas' "
                                   "transmit_power_dbm ({:g}), is {:g}",
                                   tag.id, max_dbm, tag.model->sensitivity_dbm));
  }
}

void read_bodies(YamlMap& map, Scenario& scenario, const RadioDefaults& radio,
                 Diagnostics& diagnostics) {
  for (const YamlValue& robot : map.list("robots")) {
    scenario.robots.push_back(robot_of(YamlMap(robot), scenario.materials));
  }
  for (const YamlValue& antenna : map.list("antennas")) {
    scenario.antennas.push_back(antenna_of(YamlMap(antenna), radio, diagnostics));
  }
  scenario.tags = tags_of(map, radio, diagnostics);
  if (!scenario.antennas.empty()) require_power_for_tags(scenario);
}

double time_step_of(const YamlValue& value) {
  const double seconds = seconds_of(value, kPositive);
  if (!(seconds >= 1e-6 && seconds <= 1.0)) {
    value.fail(fmt::format("must be from 1e-6 to 1 s, is {}", seconds));
  }
  return seconds;
}

Scenario scenario_of(YamlMap map, bool world_is_given, const std::vector<Method>& methods,
                     Diagnostics& diagnostics) {
  if (map.has("methods") && (map.has("conditions") || map.has("sweep"))) {
    map.self().fail("is a suite, not a scenario: for 'tagfield bench' or 'tagfield sweep'");
  }
  Scenario scenario;
  scenario.name = map.text("name", fs::path(map.self().file()).stem().string());
  scenario.description = map.text("description", "");
  const RadioDefaults radio = radio_defaults_of(map, diagnostics);
  scenario.materials = radio_world_options_of(map);
  if (map.has("seed")) scenario.seed = map.at("seed").whole_number();
  if (map.has("time_step_s")) scenario.time_step_s = time_step_of(map.at("time_step_s"));
  if (map.has("duration_s")) scenario.duration_s = seconds_of(map.at("duration_s"), kPositive);
  scenario.real_time = map.number("real_time", scenario.real_time, kNotNegative);
  if (map.has("world")) scenario.world = world_of(YamlMap(map.at("world")), world_is_given);
  if (map.has("pose")) scenario.pose = belief_of(YamlMap(map.at("pose")));
  if (map.has("navigation")) {
    const YamlValue navigation = map.at("navigation");
    const PoseSource source = read_navigation(navigation, own_navigation(scenario));
    if (map.has("pose") && map.at("pose").node()["source"] && source != scenario.pose.source) {
      navigation.fail(fmt::format("is {}, but pose.source is {}", to_string(source),
                                  to_string(scenario.pose.source)));
    }
    scenario.pose.source = source;
  }
  for (const YamlValue& obstacle : map.list("obstacles")) {
    scenario.obstacles.push_back(obstacle_of(YamlMap(obstacle), scenario.materials));
  }
  scenario.zones = zones_of(map);
  static_cast<void>(map.has("plan"));  // load_scenario_to_plan() reads it.
  if (map.has("tracking")) scenario.tracking = tracking_of(YamlMap(map.at("tracking")));
  if (map.has("localization")) {
    scenario.localization = localization_of(map.at("localization"), methods, diagnostics);
  }
  read_bodies(map, scenario, radio, diagnostics);
  if (map.has("robots") && scenario.pose.source != PoseSource::kSlam) {
    for (const YamlValue& robot : map.list("robots")) forbid_self_driving(YamlMap(robot));
  }
  warn_of_idle_keys(map, scenario, diagnostics);
  map.finish();
  return scenario;
}

bool any_physical(const Scenario& scenario) {
  return std::any_of(scenario.antennas.begin(), scenario.antennas.end(),
                     [](const AntennaSpec& antenna) { return meets_world(antenna.parameters); });
}

/// Whether obstacles affect any antenna's waves.
bool any_meets_bodies(const Scenario& scenario) {
  return std::any_of(scenario.antennas.begin(), scenario.antennas.end(),
                     [](const AntennaSpec& antenna) {
                       const RadioModel* const model = physical(antenna.parameters);
                       return model != nullptr && model->effects.bodies;
                     });
}

void require_end(const Scenario& scenario, const std::string& path) {
  const bool any_drives = std::any_of(scenario.robots.begin(), scenario.robots.end(), drives);
  if (!scenario.duration_s && !any_drives && !end_of_recordings(scenario.antennas)) {
    fail({path, 0},
         "has no 'duration_s', which must be given where no robot has waypoints and no antenna is "
         "recorded");
  }
}

double planned_duration_s(const Scenario& scenario) {
  constexpr double kUsual_s = 10.0;
  return scenario.duration_s.value_or(kUsual_s);
}

/// A scenario, and the error that applies if none of its antennas is a physical one.
struct ReadScenario {
  Scenario scenario;
  std::optional<Error> without_physical_antenna;
  std::vector<PlacedKey> of_physical_models;  ///< Without effect if there is none.
  std::optional<PlanSpec> plan;
  bool has_plan = false;  ///< Whether there is a section `plan`, read or not.
};

void require_use_of_keys(const ReadScenario& read) {
  if (read.without_physical_antenna && !any_physical(read.scenario)) {
    throw Error(*read.without_physical_antenna);
  }
}

PlanSpec read_plan(YamlMap& map, const Scenario& scenario, Diagnostics& diagnostics) {
  Diagnostics heard;  // Warnings about the scenario's own radio keys, reported before.
  const RadioDefaults radio = radio_defaults_of(map, heard);
  return plan_of(YamlMap(map.at("plan")), radio, planned_duration_s(scenario), diagnostics);
}

/// `scene`: the world if it was passed along with the scenario, else null. The section `plan` is
/// read only if `to_plan` is set.
ReadScenario read_scenario(const YAML::Node& root, const std::string& path,
                           const std::vector<Override>& overrides, const Scene* scene,
                           const std::vector<Method>& methods, Diagnostics& diagnostics,
                           bool to_plan = false) {
  for (const auto& [key, value] : overrides) set_in_yaml(root, key, value);
  try {
    YamlMap map(YamlValue(root, path, ""));
    ReadScenario read{scenario_of(map, scene != nullptr, methods, diagnostics),
                      key_without_physical_antenna(map), keys_of_physical_models(map), std::nullopt,
                      map.has("plan")};
    if (!to_plan) return read;
    if (!map.has("plan")) {
      fail({path, 0}, "has no 'plan': where antennas and tags can be (docs/plan.md)");
    }
    read.plan = read_plan(map, read.scenario, diagnostics);
    return read;
  } catch (const YAML::Exception& error) {
    fail({path, error.mark.line + 1}, error.msg);
  }
}

Scene scene_of(const WorldSpec& world, WorldOptions options, Diagnostics& diagnostics) {
  options.skip_missing = options.skip_missing || world.skip_missing;
  return load_world(world.path, world.search_paths, diagnostics, options);
}

ScenarioWithWorld with_world(ReadScenario read, const std::string& path, const Scene* scene,
                             Diagnostics& diagnostics, const WorldOptions& world_options = {}) {
  ScenarioWithWorld loaded;
  Scenario& scenario = loaded.scenario;
  scenario = read.scenario;
  if (scene != nullptr) loaded.scene = *scene;
  if (!scenario.world.path.empty()) {
    loaded.scene = scene_of(scenario.world, world_options, diagnostics);
    add_placements(loaded.scene, scenario, diagnostics);
    require_epcs(scenario.tags);
  }
  if (any_physical(scenario)) {
    scenario.radio_world = std::make_shared<const RadioWorld>(
        radio_world(loaded.scene, scenario.materials, diagnostics));
  }
  if (scenario.antennas.empty()) {
    fail({path, 0},
         fmt::format("no antennas: neither the scenario nor its world has one{}",
                     read.has_plan ? "; 'tagfield plan' chooses some by the section 'plan' and "
                                     "writes layout.yaml, a scenario with them"
                                   : ""));
  }
  read.scenario.antennas = scenario.antennas;
  require_use_of_keys(read);
  if (scenario.tags.empty()) fail({path, 0}, "no tags: neither the scenario nor its world has one");
  warn_of_idle_settings(scenario, read.of_physical_models, diagnostics);
  require_use_of_neighbours(scenario, diagnostics);
  if (any_meets_bodies(scenario)) warn_of_thin_obstacles(scenario.obstacles, diagnostics);
  require_readers_of_zones(scenario);
  require_end(scenario, path);
  return loaded;
}

/// Warns of tags of the plan in a zone that no mount is for and the scenario does not have, and of
/// a limit on cross reads that nothing can break.
void warn_of_zones(const Scenario& scenario, const PlanSpec& plan, Diagnostics& diagnostics) {
  const bool has_zone =
      !scenario.zones.empty() || std::any_of(plan.tags.begin(), plan.tags.end(),
                                             [](const auto& tags) { return !tags.zone.empty(); });
  if (plan.limits.cross && !has_zone) {
    diagnostics.warn("plan.limits.cross_reads has no effect: no tags are in a zone");
  }
  std::vector<std::string> known;
  for (const PlanMount& mount : plan.mounts) {
    if (mount.zone.empty()) return;  // It is for all zones.
    known.push_back(mount.zone);
  }
  for (const ZoneSpec& zone : scenario.zones) known.push_back(zone.name);
  for (const PlanTags& tags : plan.tags) {
    if (tags.zone.empty() || std::count(known.begin(), known.end(), tags.zone) > 0) continue;
    diagnostics.warn(tags.location,
                     fmt::format("zone '{}' of the tags '{}': no mount is for it, so no reader is "
                                 "meant to read them{}",
                                 tags.zone, tags.name, suggestion(tags.zone, known)));
  }
}

/// Adds the scenario's stationary tags, each at its own pose; moving ones are not planned for.
void add_own_tags(const Scenario& scenario, Diagnostics& diagnostics, PlanSpec& plan) {
  std::size_t moving = 0;
  std::size_t passing = 0;
  for (const TagSpec& tag : scenario.tags) {
    if (moves(tag)) {
      ++moving;
      continue;
    }
    if (tag.appears > Time{} || tag.disappears) ++passing;
    const RigidTransform& X_WT = tag.motion.front().X_WB;
    PlanTags alone;
    alone.name = tag.id;
    alone.model = tag.model ? tag.model : default_tag_model();
    alone.places = {X_WT.translation};
    alone.orientations = {X_WT.rotation};
    alone.count = 1;
    alone.location = tag.location;
    const std::size_t zone = zone_at(scenario.zones, X_WT.translation);
    if (zone < scenario.zones.size()) alone.zone = scenario.zones[zone].name;
    plan.tags.push_back(std::move(alone));
  }
  if (passing > 0) {
    diagnostics.warn(fmt::format(
        "{} of the scenario's tags appear later or disappear: they are planned for as present all "
        "the time",
        passing));
  }
  if (moving > 0) {
    diagnostics.warn(
        fmt::format("{} of the scenario's tags move and are not planned for: give them "
                    "as plan.tags with a path",
                    moving));
  }
}

}  // namespace

Override parse_override(const std::string& argument) {
  const std::size_t equals = argument.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == argument.size()) {
    fail({"--set " + argument, 0}, "expected key.path=value");
  }
  return {argument.substr(0, equals), argument.substr(equals + 1)};
}

Scenario load_scenario(const std::string& path, const std::vector<Override>& overrides,
                       Diagnostics& diagnostics, const std::vector<Method>& methods) {
  const ReadScenario read =
      read_scenario(read_yaml(path), path, overrides, nullptr, methods, diagnostics);
  // If there is a world, it may add antennas.
  if (read.scenario.world.path.empty()) {
    require_use_of_keys(read);
    warn_of_idle_settings(read.scenario, read.of_physical_models, diagnostics);
    require_use_of_neighbours(read.scenario, diagnostics);
    if (any_meets_bodies(read.scenario)) {
      warn_of_thin_obstacles(read.scenario.obstacles, diagnostics);
    }
  }
  return read.scenario;
}

Scenario load_scenario(const std::string& path, const std::vector<Override>& overrides) {
  Diagnostics unheard;
  return load_scenario(path, overrides, unheard);
}

ScenarioWithWorld load_scenario_with_world(const std::string& path,
                                           const std::vector<Override>& overrides,
                                           Diagnostics& diagnostics,
                                           const WorldOptions& world_options,
                                           const std::vector<Method>& methods) {
  return with_world(read_scenario(read_yaml(path), path, overrides, nullptr, methods, diagnostics),
                    path, nullptr, diagnostics, world_options);
}

ScenarioWithWorld scenario_from_text(const std::string& text, const std::string& name,
                                     const std::vector<Override>& overrides, const Scene* scene,
                                     Diagnostics& diagnostics, const std::vector<Method>& methods) {
  return with_world(
      read_scenario(yaml_in(text, name), name, overrides, scene, methods, diagnostics), name, scene,
      diagnostics);
}

ScenarioToPlan load_scenario_to_plan(const std::string& path,
                                     const std::vector<Override>& overrides,
                                     Diagnostics& diagnostics, const WorldOptions& world_options) {
  ReadScenario read = read_scenario(read_yaml(path), path, overrides, nullptr, built_in_methods(),
                                    diagnostics, true);
  ScenarioToPlan to_plan;
  Scenario& scenario = to_plan.loaded.scenario;
  scenario = std::move(read.scenario);
  to_plan.plan = std::move(*read.plan);
  if (!scenario.world.path.empty()) {
    to_plan.loaded.scene = scene_of(scenario.world, world_options, diagnostics);
    add_placements(to_plan.loaded.scene, scenario, diagnostics);
  }
  scenario.radio_world = std::make_shared<const RadioWorld>(
      radio_world(to_plan.loaded.scene, scenario.materials, diagnostics));
  warn_of_zones(scenario, to_plan.plan, diagnostics);
  warn_of_thin_obstacles(scenario.obstacles, diagnostics);
  add_own_tags(scenario, diagnostics, to_plan.plan);
  if (to_plan.plan.tags.empty()) fail({path, 0}, "plan has no 'tags', and the scenario has none");
  if (!scenario.antennas.empty()) {
    diagnostics.warn(fmt::format("the scenario's own {} antennas are not part of the plan",
                                 scenario.antennas.size()));
  }
  return to_plan;
}

}  // namespace tagfield
