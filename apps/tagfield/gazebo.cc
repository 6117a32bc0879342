// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "adapters/gazebo_world/gz_sim_world.h"
#include "adapters/gazebo_world/scenario_world.h"
#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/json_line.h"
#include "apps/tagfield/json_option.h"
#include "apps/tagfield/output_file.h"
#include "apps/tagfield/scenario_arguments.h"
#include "apps/tagfield/shared_folder.h"
#include "apps/tagfield/speed_option.h"
#include "tagfield/files/files.h"
#include "tagfield/map/map_file.h"
#include "tagfield/scenario/scenario_yaml.h"
#include "tagfield/simulator/navigation_world.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

struct GazeboArguments {
  std::string scenario;
  std::string out;
  std::vector<std::string> settings;
  std::optional<double> real_time;
  bool as_json = false;
  bool force = false;
  std::string keep_out;
  bool gz = false;
  GzSimOptions gz_options;
  WorldOptions world;
};

/// Writes a map of where a robot must not drive although its laser sees nothing there.
void write_keep_out(const std::string& path, const Scenario& scenario, const Scene& scene,
                    Diagnostics& diagnostics) {
  const NavigationWorld world = navigation_world(scenario, scene, diagnostics);
  OccupancyGrid nothing = world.true_map;
  std::fill(nothing.cells.begin(), nothing.cells.end(), std::int8_t{-1});
  const fs::path image = fs::path(path).filename().replace_extension(".pgm");
  std::error_code ignored;  // If this fails, writing fails too.
  fs::create_directories(fs::path(path).parent_path(), ignored);
  write_text_files(
      {{(fs::path(path).parent_path() / image).string(), map_to_pgm(driving_map(nothing, world))},
       {path, map_to_yaml(nothing, image.string())}});
}

fs::path out_of(const GazeboArguments& arguments) {
  if (!arguments.out.empty()) return arguments.out;
  return fs::path(arguments.scenario).stem().concat(arguments.gz ? ".sdf" : ".world");
}

void require_replaceable_files(const GazeboArguments& arguments) {
  const std::vector<std::string> inputs = {arguments.scenario};
  const fs::path image = fs::path(arguments.keep_out).replace_extension(".pgm");
  require_replaceable({"--out", out_of(arguments), "a world", {"<sdf"}}, inputs, arguments.force);
  require_replaceable({"--keep-out", arguments.keep_out, "a map", {"occupied_thresh"}}, inputs,
                      arguments.force);
  require_replaceable({"--keep-out", image, "the image of a map", {"P5"}}, inputs, arguments.force);
}

/// Prints the world, and the environment variable for finding its models; "" for none.
void print_written(const fs::path& world, const std::string& variable, const std::string& folders,
                   bool as_json) {
  if (as_json) {
    nlohmann::ordered_json all = {{"world", world.string()},
                                  {"environment", nlohmann::ordered_json::object()}};
    if (!variable.empty()) all["environment"][variable] = folders;
    print_json_line(all);
    return;
  }
  fmt::print("world: {}\n", world.string());
  if (!variable.empty()) fmt::print("{}={}\n", variable, folders);
}

int write_gazebo_world(const GazeboArguments& arguments) {
  const std::vector<Override> overrides = overrides_in(arguments.settings);
  suggest_shared_file(arguments.scenario);
  Diagnostics diagnostics;
  const ScenarioWithWorld loaded =
      load_scenario_with_world(arguments.scenario, overrides, diagnostics, arguments.world);
  // Anything that would stop a run stops this.
  const Simulation simulation(loaded.scenario, loaded.scenario.seed);
  // Objects in the world stay there and must not be added again.
  const Scenario scenario = load_scenario(arguments.scenario, overrides);
  GazeboWorldOptions options;
  options.robot_model = (shared_folder("models") / "p3at/model.sdf").string();
  options.real_time = arguments.real_time;
  std::string text = gazebo_world(scenario, loaded.scene, options, diagnostics);
  if (arguments.gz) {
    text = gz_sim_world(text, "", arguments.gz_options, diagnostics);
  }
  if (!arguments.keep_out.empty()) {
    write_keep_out(arguments.keep_out, loaded.scenario, loaded.scene, diagnostics);
  }
  print_warnings(diagnostics);
  const fs::path out = out_of(arguments);
  catch_interrupts();  // The rest takes only a moment, and no incomplete files remain.
  write_text_file(out.string(), text);
  std::vector<std::string> folders = gazebo_model_paths(scenario);
  const std::string shared = shared_folder("models").string();
  if (std::find(folders.begin(), folders.end(), shared) == folders.end()) folders.push_back(shared);
  const char* const variable = arguments.gz ? "GZ_SIM_RESOURCE_PATH" : "GAZEBO_MODEL_PATH";
  print_written(out, variable, fmt::format("{}", fmt::join(folders, ":")), arguments.as_json);
  return kExitOk;
}

/// Converts a user's Gazebo 11 world or model to gz-sim.
int convert_world(const GazeboArguments& arguments) {
  if (!arguments.settings.empty() || arguments.real_time || !arguments.keep_out.empty()) {
    throw Error("--set, --speed and --keep-out are for scenarios, not for worlds");
  }
  Diagnostics diagnostics;
  const std::string text = gz_sim_world(read_text_file(arguments.scenario), arguments.scenario,
                                        arguments.gz_options, diagnostics);
  print_warnings(diagnostics);
  const fs::path out = out_of(arguments);
  catch_interrupts();  // The rest takes only a moment, and no incomplete files remain.
  write_text_file(out.string(), text);
  print_written(out, "", "", arguments.as_json);
  return kExitOk;
}

int write_world(const GazeboArguments& arguments) {
  require_replaceable_files(arguments);
  const fs::path kind = fs::path(arguments.scenario).extension();
  if (kind != ".world" && kind != ".sdf") return write_gazebo_world(arguments);
  if (arguments.gz) return convert_world(arguments);
  throw Error(
      fmt::format("{}: a world, expected a scenario (with --gz it may be a world of Gazebo "
                  "11 too)",
                  arguments.scenario));
}

}  // namespace

void add_gazebo_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<GazeboArguments>();
  CLI::App* command = app.add_subcommand(
      "gazebo", "Write a scenario as a world of Gazebo 11, or of gz-sim, with Tagfield in it");
  command
      ->add_option("SCENARIO", arguments->scenario,
                   "Scenario file (YAML); with --gz also a .world or .sdf of Gazebo 11")
      ->required();
  command->add_option("--out", arguments->out, "File to write (default NAME.world, or NAME.sdf)");
  add_force_option(*command, arguments->force);
  add_json_option(*command, arguments->as_json,
                  "{\"world\": FILE, \"environment\": "
                  "{VARIABLE: FOLDERS}}");
  add_world_options(*command, arguments->world);
  command->add_option("--set", arguments->settings, "Replace a value of the scenario, as in 'run'")
      ->take_all()
      ->allow_extra_args(false);
  add_speed_option(*command, arguments->real_time, "as the scenario or its world says",
                   "--speed,--real-time");
  command->add_option(
      "--keep-out", arguments->keep_out,
      "Also write a map (YAML, image beside) of what robots can hit but their laser "
      "can't see, for navigation 'slam'");
  CLI::Option* const gz = command->add_flag(
      "--gz", arguments->gz, "For gz-sim: Fortress, Harmonic and later (docs/gz.md)");
  command
      ->add_option("--mcap", arguments->gz_options.mcap, "gz-sim records its run to this MCAP file")
      ->needs(gz);
  command
      ->add_flag("--stop-at-end", arguments->gz_options.stops_at_end,
                 "gz-sim ends when the first robot has driven its waypoints")
      ->needs(gz);
  command->footer(
      "Prints the folders that GAZEBO_MODEL_PATH (GZ_SIM_RESOURCE_PATH) must name for the world.\n"
      "GAZEBO_PLUGIN_PATH (GZ_SIM_SYSTEM_PLUGIN_PATH) must name the folder with Tagfield's "
      "plugins;\n"
      "scripts/gazebo-experiment and scripts/gz-experiment do all of that.");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return write_world(*arguments); }; });
}

}  // namespace tagfield
