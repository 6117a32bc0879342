#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/long_runs.h"
#include "apps/tagfield/scenario_arguments.h"
#include "tagfield/field/antenna_facts.h"
#include "tagfield/scenario/placements.h"
#include "tagfield/scenario/scenario_yaml.h"
#include "tagfield/sdf/load_world.h"
#include "tagfield/simulator/navigation_world.h"
#include "tagfield/simulator/simulation.h"
#include "tagfield/world/triangulate.h"

namespace tagfield {
namespace {

using Json = nlohmann::ordered_json;

struct CheckArguments {
  std::string file;
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

Json describe(const AntennaSpec& antenna) {
  const AntennaParameters& parameters = antenna.parameters;
  return {{"name", parameters.name},
          {"on", antenna.on.empty() ? "world" : antenna.on},
          {"position_m", to_list(antenna.X_PA.translation)},
          {"frequency_hz", nominal_frequency_hz(parameters)},
          {"range_m", nominal_range_m(parameters)},
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
  for (const AntennaSpec& antenna : scenario.antennas)
    json["antennas"].push_back(describe(antenna));
  json["tags"] = Json::array();
  for (const TagSpec& tag : scenario.tags) json["tags"].push_back(describe(tag));
}

Json describe_file(const CheckArguments& arguments, Diagnostics& diagnostics) {
  const std::string extension = std::filesystem::path(arguments.file).extension().string();
  if (extension == ".yaml" || extension == ".yml") {
    std::vector<Override> overrides;
    for (const std::string& setting : arguments.settings) {
      overrides.push_back(parse_override(setting));
    }
    const ScenarioWithWorld loaded =
        load_scenario_with_world(arguments.file, overrides, diagnostics, arguments.world);
    // Whatever would stop the run stops the check.
    const Simulation simulation(loaded.scenario, loaded.scenario.seed);
    if (loaded.scenario.pose.source == PoseSource::kSlam) {
      navigation_world(loaded.scenario, loaded.scene, diagnostics);
    }
    warn_of_long_run(loaded.scenario, true, diagnostics);
    Json json = {{"scenario", loaded.scenario.name}};
    json.update(describe(loaded.scene));
    add_scenario(loaded.scenario, json);
    return json;
  }
  if (extension != ".sdf" && extension != ".world") {
    fail({arguments.file, 0}, "expected a .yaml scenario or an .sdf or .world file");
  }
  const Scene scene =
      load_world(arguments.file, arguments.model_paths, diagnostics, arguments.world);
  Scenario scenario;
  add_placements(scene, scenario, diagnostics);
  Json json = describe(scene);
  add_scenario(scenario, json);
  return json;
}

void print_collisions(const Json& json) {
  fmt::print("collisions: {}, {} triangles\n", json["collisions"].size(),
             json["triangles"].get<std::size_t>());
  for (const Json& collision : json["collisions"]) {
    fmt::print("  {:<70} {:<8} {:>7}\n", collision["name"].get<std::string>(),
               collision["shape"].get<std::string>(), collision["triangles"].get<std::size_t>());
  }
}

std::string place_of(const Json& body) {
  const auto p = body["position_m"].get<std::vector<double>>();
  return fmt::format("({:.3f}, {:.3f}, {:.3f}) m on {}", p[0], p[1], p[2],
                     body["on"].get<std::string>());
}

void print_text(const std::string& file, const Json& json) {
  fmt::print("{}: good\n", file);
  if (json.contains("scenario")) fmt::print("scenario: {}\n", json["scenario"].get<std::string>());
  fmt::print("world: {}\n", json["world"].get<std::string>().empty()
                                ? "none (empty space)"
                                : json["world"].get<std::string>());
  const auto nested = static_cast<std::size_t>(std::count_if(
      json["models"].begin(), json["models"].end(),
      [](const Json& name) { return name.get<std::string>().find("::") != std::string::npos; }));
  fmt::print("models: {}{}\n", json["models"].size() - nested,
             nested > 0 ? fmt::format(", and {} nested in them", nested) : "");
  print_collisions(json);
  fmt::print("materials: {}\n", json["materials"].size());
  for (const Json& material : json["materials"]) {
    fmt::print("  {}\n", material.get<std::string>());
  }
  for (const Json& robot : json["robots"]) {
    fmt::print("robot {}: {:.2f} m over its waypoints\n", robot["name"].get<std::string>(),
               robot["path_m"].get<double>());
  }
  fmt::print("antennas: {}\n", json["antennas"].size());
  for (const Json& antenna : json["antennas"]) {
    fmt::print("  {:<20} {}, {:.1f} MHz, range {} m, {} Hz\n", antenna["name"].get<std::string>(),
               place_of(antenna), antenna["frequency_hz"].get<double>() / 1e6,
               antenna["range_m"].get<double>(), antenna["rate_hz"].get<double>());
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
    print_text(arguments.file, json);
  }
  return kExitOk;
}

}  // namespace

void add_check_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command = app.add_subcommand(
      "check", "Say what is in a scenario or world file, or what is wrong and in which line");
  command->add_option("FILE", arguments->file, "FILE.yaml, FILE.sdf or FILE.world")->required();
  command->add_option("--set", arguments->settings, "Replace a value of the scenario, as in 'run'")
      ->take_all()
      ->allow_extra_args(false);
  command
      ->add_option("--model-path", arguments->model_paths,
                   "Folder to look up model://NAME in; can be given several times")
      ->allow_extra_args(false);
  add_world_options(*command, arguments->world);
  command->add_flag("--json", arguments->as_json, "JSON for machines instead of text");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return check_file(*arguments); }; });
}

}  // namespace tagfield
