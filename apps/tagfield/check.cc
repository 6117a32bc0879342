// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/tagfield/checked_file.h"
#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/foreign_tables.h"
#include "apps/tagfield/json_option.h"
#include "apps/tagfield/long_runs.h"
#include "apps/tagfield/scenario_arguments.h"
#include "apps/tagfield/shared_folder.h"
#include "tagfield/channel/radio_world.h"
#include "tagfield/field/antenna_facts.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/report/text.h"
#include "tagfield/scenario/late_tags.h"
#include "tagfield/scenario/placements.h"
#include "tagfield/scenario/plan_spec.h"
#include "tagfield/scenario/scenario_yaml.h"
#include "tagfield/scenario/tag_kinds.h"
#include "tagfield/sdf/load_world.h"
#include "tagfield/simulator/navigation_world.h"
#include "tagfield/simulator/simulation.h"
#include "tagfield/world/triangulate.h"

namespace tagfield {
namespace {

using Json = nlohmann::ordered_json;

struct CheckArguments {
  CheckedFile of;
  std::vector<std::string> settings;
  std::vector<std::string> model_paths;
  bool as_json = false;
  WorldOptions world;
};

std::vector<double> to_list(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

const char* shape_name(const Shape& shape) {
  constexpr const char* kNames[] = {"box", "cylinder", "sphere", "plane", "mesh"};
  return kNames[shape.index()];
}

Json describe(const Scene& scene) {
  Json json = {{"world", scene.name}, {"models", scene.models}};
  std::size_t triangles = 0;
  json["collisions"] = Json::array();
  for (const Collision& collision : scene.collisions) {
    const std::size_t count = triangle_count(collision.shape);
    triangles += count;
    json["collisions"].push_back(
        {{"name", collision.name}, {"shape", shape_name(collision.shape)}, {"triangles", count}});
  }
  json["triangles"] = triangles;
  json["materials"] = scene.materials;
  return json;
}

/// What waves meet in the world: materials stated by rules or guessed.
void add_materials_for_waves(const Scenario& scenario, Json& json) {
  if (!scenario.radio_world) return;
  const RadioWorld& world = *scenario.radio_world;
  json["material_rules"] = scenario.materials.rules.size();
  json["materials_for_waves"] = Json::array();
  for (std::uint32_t i = 0; i < world.materials.size(); ++i) {
    json["materials_for_waves"].push_back(
        {{"material", world.materials[i].name},
         {"collisions", std::count(world.material_of.begin(), world.material_of.end(), i)}});
  }
}

/// Value of the key `model`: "paper", "link_budget", "multipath".
std::string model_of(const AntennaParameters& antenna) {
  const RadioModel* const model = physical(antenna);
  if (model == nullptr) return "paper";
  for (const RawParameter& setting : model->settings) {
    if (setting.key == "model") return setting.value;
  }
  return "physical";
}

Json describe(const AntennaSpec& antenna,
              const std::vector<std::shared_ptr<const TagModel>>& kinds) {
  const AntennaParameters& parameters = antenna.parameters;
  return {{"name", parameters.name},
          {"model", model_of(parameters)},
          {"on", antenna.on.empty() ? "world" : antenna.on},
          {"position_m", to_list(antenna.X_PA.translation)},
          {"frequency_hz", nominal_frequency_hz(parameters)},
          {"range_m", nominal_range_m(parameters, kinds)},
          {"max_range_m", largest_range_m(parameters, kinds)},
          {"rate_hz", parameters.rate_hz}};
}

Json describe(const TagSpec& tag) {
  return {{"id", tag.id},
          {"on", tag.on.empty() ? "world" : tag.on},
          {"position_m", to_list(tag.motion.front().X_WB.translation)},
          {"moves", moves(tag)}};
}

void add_scenario(const Scenario& scenario, Json& json) {
  json["robots"] = Json::array();
  for (const RobotSpec& robot : scenario.robots) {
    json["robots"].push_back({{"name", robot.name}, {"path_m", planned_length(robot)}});
  }
  json["antennas"] = Json::array();
  const auto kinds = kinds_of_tags(scenario);
  for (const AntennaSpec& antenna : scenario.antennas) {
    json["antennas"].push_back(describe(antenna, kinds));
  }
  json["tags"] = Json::array();
  for (const TagSpec& tag : scenario.tags) json["tags"].push_back(describe(tag));
}

Json describe_scenario(const CheckArguments& arguments, Diagnostics& diagnostics) {
  const ScenarioWithWorld loaded = load_scenario_with_world(
      arguments.of.path, overrides_in(arguments.settings), diagnostics, arguments.world);
  // Anything that would stop the run stops the check.
  const Simulation simulation(loaded.scenario, loaded.scenario.seed);
  if (loaded.scenario.pose.source == PoseSource::kSlam) {
    navigation_world(loaded.scenario, loaded.scene, diagnostics);
  }
  warn_of_long_run(loaded.scenario, true, diagnostics);
  if (loaded.scenario.duration_s) {
    warn_of_late_tags(loaded.scenario, *loaded.scenario.duration_s, diagnostics);
    warn_of_late_kidnappings(loaded.scenario, *loaded.scenario.duration_s, diagnostics);
  }
  Json json = {{"kind", "scenario"}, {"scenario", loaded.scenario.name}};
  json.update(describe(loaded.scene));
  add_materials_for_waves(loaded.scenario, json);
  add_scenario(loaded.scenario, json);
  return json;
}

Json describe_plan(const CheckArguments& arguments, Diagnostics& diagnostics) {
  const ScenarioToPlan to_plan = load_scenario_to_plan(
      arguments.of.path, overrides_in(arguments.settings), diagnostics, arguments.world);
  Json json = {{"kind", "plan"}, {"scenario", to_plan.loaded.scenario.name}};
  std::size_t places = 0;
  for (const PlanTags& tags : to_plan.plan.tags) places += tags.places.size();
  json["tag_groups"] = to_plan.plan.tags.size();
  json["tag_positions"] = places;
  json["mounts"] = to_plan.plan.mounts.size();
  json["max_antennas"] = to_plan.plan.limits.antennas;
  std::map<std::string, std::size_t> models;
  for (const PlanMount& mount : to_plan.plan.mounts) ++models[model_of(mount.antenna)];
  json["models_of_antennas"] = models;
  json.update(describe(to_plan.loaded.scene));
  add_materials_for_waves(to_plan.loaded.scenario, json);
  add_scenario(to_plan.loaded.scenario, json);
  return json;
}

Json describe_world(const CheckArguments& arguments, Diagnostics& diagnostics) {
  const Scene scene =
      load_world(arguments.of.path, arguments.model_paths, diagnostics, arguments.world);
  Scenario scenario;
  add_placements(scene, scenario, diagnostics);
  Json json = {{"kind", "world"}};
  json.update(describe(scene));
  add_scenario(scenario, json);
  return json;
}

/// The file is of another kind than what the option is for.
[[noreturn]] void refuse_option(const CheckArguments& arguments, const std::string& option,
                                const std::string& what) {
  throw Error(
      fmt::format("check: {} {}, which this file is not: {}", option, what, arguments.of.path));
}

Json describe_file(const CheckArguments& arguments, Diagnostics& diagnostics) {
  suggest_shared_file(arguments.of.path);
  const std::string kind = kind_of_file(arguments.of);
  const bool is_in_space = kind == "scenario" || kind == "plan" || kind == "world";
  if (is_in_space && !arguments.of.poses.empty()) {
    refuse_option(arguments, "--poses", "is for tables of reads");
  }
  if (kind == "scenario") return describe_scenario(arguments, diagnostics);
  if (kind == "plan") return describe_plan(arguments, diagnostics);
  if (!arguments.settings.empty()) {
    refuse_option(arguments, "--set", "changes a scenario");
  }
  if (kind == "world") return describe_world(arguments, diagnostics);
  return describe_checked_file(arguments.of, kind, diagnostics);
}

/// A fact's name in words, and its unit, which keys end with: "duration_s" → "duration", "s".
struct FactName {
  std::string words;
  std::string unit;
};

FactName fact_name(const std::string& key) {
  constexpr std::pair<const char*, const char*> kUnits[] = {
      {"_s", "s"},     {"_m", "m"},     {"_m_s", "m/s"}, {"_db", "dB"},
      {"_dbi", "dBi"}, {"_dbm", "dBm"}, {"_hz", "Hz"},   {"_khz", "kHz"},
      {"_us", "µs"},   {"_rad", "rad"}, {"_deg", "°"},   {"_ms", "ms"}};
  FactName name{key, ""};
  std::size_t longest = 0;
  for (const auto& [ending, unit] : kUnits) {
    const std::string end = ending;
    if (end.size() <= longest || key.size() <= end.size()) continue;
    if (key.compare(key.size() - end.size(), end.size(), end) != 0) continue;
    longest = end.size();
    name = {key.substr(0, key.size() - longest), unit};
  }
  std::replace(name.words.begin(), name.words.end(), '_', ' ');
  return name;
}

/// Ten digits, more than any measurement has: without the rounding errors of sums.
std::string fact_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  return value.is_number_float() ? fmt::format("{:.10g}", value.get<double>()) : value.dump();
}

/// How many names, and the first of them; all of several numbers, such as coordinates.
std::string list_text(const Json& values) {
  constexpr std::size_t kMaxNames = 12;
  std::string names;
  for (std::size_t i = 0; i < values.size() && i < kMaxNames; ++i) {
    names += (i == 0 ? "" : ", ") + fact_text(values[i]);
  }
  if (!values.empty() && values[0].is_number()) return names;
  return fmt::format("{}{}{}", values.size(), values.empty() ? "" : ": " + names,
                     values.size() > kMaxNames ? ", …" : "");
}

/// Prints the contents of a file, one fact per line.
void print_facts(const Json& json) {
  for (const auto& [key, value] : json.items()) {
    const FactName name = fact_name(key);
    const std::string text = value.is_array() ? list_text(value) : fact_text(value);
    const bool has_unit = !name.unit.empty() && !text.empty();
    fmt::print("{}: {}{}{}\n", name.words, text, has_unit ? " " : "", has_unit ? name.unit : "");
  }
}

/// Active models of antennas: "multipath", or with several "paper (1 antenna), multipath (3)".
std::string models_in_force(const Json& antennas) {
  std::map<std::string, std::size_t> counts;
  for (const Json& antenna : antennas) ++counts[antenna["model"].get<std::string>()];
  if (counts.size() == 1) return counts.begin()->first;
  std::string text;
  for (const auto& [model, count] : counts) {
    text += fmt::format("{}{} ({} antenna{})", text.empty() ? "" : ", ", model, count,
                        count == 1 ? "" : "s");
  }
  return text;
}

void print_collisions(const Json& json) {
  fmt::print("collisions: {}, {} triangles\n", json["collisions"].size(),
             json["triangles"].get<std::size_t>());
  for (const Json& collision : json["collisions"]) {
    fmt::print("  {:<70} {:<8} {:>7}\n", collision["name"].get<std::string>(),
               collision["shape"].get<std::string>(), collision["triangles"].get<std::size_t>());
  }
}

void print_materials(const Json& json) {
  fmt::print("materials named in the world: {}\n", json["materials"].size());
  for (const Json& material : json["materials"]) {
    fmt::print("  {}\n", material.get<std::string>());
  }
  if (!json.contains("materials_for_waves")) return;
  const auto rules = json["material_rules"].get<std::size_t>();
  fmt::print("materials for waves: {}{}\n", json["materials_for_waves"].size(),
             rules > 0 ? ", by " + counted(rules, "rule") : "");
  for (const Json& entry : json["materials_for_waves"]) {
    fmt::print("  {:<20} {}\n", entry["material"].get<std::string>(),
               counted(entry["collisions"].get<std::size_t>(), "collision"));
  }
}

std::string place_of(const Json& body) {
  const auto p = body["position_m"].get<std::vector<double>>();
  return fmt::format("({:.3f}, {:.3f}, {:.3f}) m on {}", p[0], p[1], p[2],
                     body["on"].get<std::string>());
}

void print_text(const std::string& file, const Json& json, std::size_t warnings) {
  fmt::print("{}: {}\n", file,
             warnings == 0 ? "good" : "can be read, with " + counted(warnings, "warning"));
  if (!json.contains("world")) {
    print_facts(json);
    return;
  }
  if (json.contains("scenario")) fmt::print("scenario: {}\n", json["scenario"].get<std::string>());
  if (!json["antennas"].empty()) fmt::print("model: {}\n", models_in_force(json["antennas"]));
  if (json["kind"] == "plan") {
    for (const auto& [model, count] : json["models_of_antennas"].items()) {
      fmt::print("model: {}, of {} mounts\n", model, count.get<std::size_t>());
    }
    fmt::print("plan: {} tag positions in {} groups, {} mounts, at most {} antennas\n",
               json["tag_positions"].get<std::size_t>(), json["tag_groups"].get<std::size_t>(),
               json["mounts"].get<std::size_t>(), json["max_antennas"].get<std::size_t>());
  }
  fmt::print("world: {}\n", json["world"].get<std::string>().empty()
                                ? "none (empty space)"
                                : json["world"].get<std::string>());
  const auto nested = static_cast<std::size_t>(std::count_if(
      json["models"].begin(), json["models"].end(),
      [](const Json& name) { return name.get<std::string>().find("::") != std::string::npos; }));
  fmt::print("models: {}{}\n", json["models"].size() - nested,
             nested > 0 ? fmt::format(", and {} nested in them", nested) : "");
  print_collisions(json);
  print_materials(json);
  for (const Json& robot : json["robots"]) {
    fmt::print("robot {}: {:.2f} m over its waypoints\n", robot["name"].get<std::string>(),
               robot["path_m"].get<double>());
  }
  fmt::print("antennas: {}\n", json["antennas"].size());
  for (const Json& antenna : json["antennas"]) {
    const auto range_m = antenna["range_m"].get<double>();
    const auto most_m = antenna["max_range_m"].get<double>();
    fmt::print(
        "  {:<20} {}, {:.1f} MHz, range {:.4g} m{}, {:.4g} Hz\n",
        antenna["name"].get<std::string>(), place_of(antenna),
        antenna["frequency_hz"].get<double>() / 1e6, range_m,
        most_m > range_m
            ? fmt::format(" in free space, at most {:.4g} m where other paths add up", most_m)
            : "",
        antenna["rate_hz"].get<double>());
  }
  fmt::print("tags: {}\n", json["tags"].size());
  for (const Json& tag : json["tags"]) {
    fmt::print("  {:<20} {}{}\n", tag["id"].get<std::string>(), place_of(tag),
               tag["moves"].get<bool>() ? ", moves" : "");
  }
}

int check_file(const CheckArguments& arguments) {
  Diagnostics diagnostics;
  Json json = describe_file(arguments, diagnostics);
  print_warnings(diagnostics);
  if (arguments.as_json) {
    json["warnings"] = diagnostics.warnings();
    fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
  } else {
    print_text(arguments.of.path, json, diagnostics.warnings().size());
  }
  return kExitOk;
}

}  // namespace

void add_check_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command = app.add_subcommand(
      "check", "Show what is in a file of any kind, or what is wrong and in which line");
  command
      ->add_option(
          "FILE", arguments->of.path,
          "Scenario, plan, suite, sweep, events, profile, calibration or map (YAML), world "
          "(.sdf, .world), table (CSV, also in an archive), recording of ROS (.bag, .mcap, .db3), "
          "other results (.json, .jsonl, .sqlite, .html, .svg), or a folder of results")
      ->required();
  command->add_option("--poses", arguments->of.poses,
                      "With a table of reads: the poses of its antennas (CSV), which are then "
                      "checked together, as by 'localize'");
  add_format_option(*command, arguments->of.format);
  command->add_option("--set", arguments->settings, "Replace a value of the scenario, as in 'run'")
      ->take_all()
      ->allow_extra_args(false);
  command
      ->add_option("--model-path", arguments->model_paths,
                   "Folder to look up model://NAME in; can be given several times")
      ->allow_extra_args(false);
  add_world_options(*command, arguments->world);
  add_json_option(*command, arguments->as_json);
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return check_file(*arguments); }; });
}

}  // namespace tagfield
