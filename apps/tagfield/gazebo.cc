#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "adapters/gazebo_classic/world/scenario_world.h"
#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/shared_folder.h"
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
  std::string keep_out;
};

/// Where a robot must not drive although its laser sees nothing there, as a map.
void write_keep_out(const std::string& path, const Scenario& scenario, const Scene& scene,
                    Diagnostics& diagnostics) {
  const NavigationWorld world = navigation_world(scenario, scene, diagnostics);
  OccupancyGrid nothing = world.true_map;
  std::fill(nothing.cells.begin(), nothing.cells.end(), std::int8_t{-1});
  const fs::path image = fs::path(path).filename().replace_extension(".pgm");
  std::error_code ignored;  // What can't be made can't be written to either.
  fs::create_directories(fs::path(path).parent_path(), ignored);
  write_text_files(
      {{(fs::path(path).parent_path() / image).string(), map_to_pgm(driving_map(nothing, world))},
       {path, map_to_yaml(nothing, image.string())}});
}

int write_gazebo_world(const GazeboArguments& arguments) {
  std::vector<Override> overrides;
  for (const std::string& setting : arguments.settings) {
    overrides.push_back(parse_override(setting));
  }
  Diagnostics diagnostics;
  const ScenarioWithWorld loaded =
      load_scenario_with_world(arguments.scenario, overrides, diagnostics);
  // Whatever would stop a run stops this.
  const Simulation simulation(loaded.scenario, loaded.scenario.seed);
  // What stands in the world stays there, and is not to be added.
  const Scenario scenario = load_scenario(arguments.scenario, overrides);
  GazeboWorldOptions options;
  options.robot_model = (shared_folder("models") / "p3at/model.sdf").string();
  options.real_time = arguments.real_time;
  const std::string text = gazebo_world(scenario, loaded.scene, options, diagnostics);
  if (!arguments.keep_out.empty()) {
    write_keep_out(arguments.keep_out, loaded.scenario, loaded.scene, diagnostics);
  }
  print_warnings(diagnostics);
  const fs::path out = arguments.out.empty() ? fs::path(arguments.scenario).stem().concat(".world")
                                             : fs::path(arguments.out);
  write_text_file(out.string(), text);
  std::vector<std::string> folders = gazebo_model_paths(scenario);
  folders.push_back(shared_folder("models").string());
  fmt::print("world: {}\nGAZEBO_MODEL_PATH={}\n", out.string(), fmt::join(folders, ":"));
  return kExitOk;
}

}  // namespace

void add_gazebo_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<GazeboArguments>();
  CLI::App* command =
      app.add_subcommand("gazebo", "Write a scenario as a world of Gazebo 11 with Tagfield in it");
  command->add_option("SCENARIO", arguments->scenario, "Scenario file (YAML)")->required();
  command->add_option("--out", arguments->out, "File to write (default NAME.world)");
  command->add_option("--set", arguments->settings, "Replace a value of the scenario, as in 'run'")
      ->take_all()
      ->allow_extra_args(false);
  command
      ->add_option("--real-time", arguments->real_time,
                   "Multiple of real time to run at, 0 for as fast as it can (default: as the "
                   "scenario or its world says)")
      ->check(CLI::Range(0.0, 1e6));
  command->add_option(
      "--keep-out", arguments->keep_out,
      "Also write a map (YAML, image beside) of what robots can hit but their laser "
      "can't see, for navigation 'slam'");
  command->footer(
      "Prints the folders that GAZEBO_MODEL_PATH must name for the world. GAZEBO_PLUGIN_PATH must\n"
      "name the folder with Tagfield's plugins; scripts/gazebo-experiment does all of that.");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return write_gazebo_world(*arguments); }; });
}

}  // namespace tagfield
