// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/scenario_arguments.h"

#include <fmt/format.h>

#include <cctype>
#include <charconv>

#include "apps/tagfield/shared_folder.h"
#include "tagfield/base/spelling.h"
#include "tagfield/base/wildcard.h"
#include "tagfield/experiment/leave_one_out.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxNames = 20;

/// Index of this name in `names`; without a name, of the only one.
std::size_t find_name(const std::string& command, const std::string& kind, const std::string& name,
                      const std::vector<std::string>& names) {
  if (name.empty() && names.size() == 1) return 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!name.empty() && names[i] == name) return i;
  }
  const std::vector<std::string> some(
      names.begin(),
      names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), kMaxNames)));
  const std::string known = suggestion(name, some);
  if (name.empty()) {
    throw Error(fmt::format("{}: the scenario has {} {}s; say which with --{} NAME{}", command,
                            names.size(), kind, kind, known));
  }
  throw Error(fmt::format("{}: --{}: there is no {} '{}'{}", command, kind, kind, name, known));
}

}  // namespace

std::string fault_of_seed(const std::string& word) {
  std::uint64_t seed = 0;
  const char* end = word.data() + word.size();
  const auto [after, error] = std::from_chars(word.data(), end, seed);
  if (error == std::errc{} && after == end) return "";
  return fmt::format("'{}' is not a whole number from 0 to 2^64 - 1", word);
}

void add_world_options(CLI::App& command, WorldOptions& options) {
  command.add_flag("--skip-missing", options.skip_missing,
                   "Go on without models and meshes of the world that are missing or broken");
  command.add_flag("--allow-outside", options.allow_outside,
                   "Let the world name files outside of its folder and the model paths");
}

void add_scenario_options(CLI::App& command, ScenarioArguments& arguments) {
  add_world_options(command, arguments.world);
  command.add_option("SCENARIO", arguments.scenario, "Scenario file (YAML)")->required();
  command.add_option("--seed", arguments.seed, "Seed instead of the scenario's")
      ->check(fault_of_seed);
  add_change_options(command, arguments.settings, arguments.without);
}

void add_change_options(CLI::App& command, std::vector<std::string>& settings,
                        std::vector<std::string>& without) {
  command
      .add_option("--set", settings,
                  "Replace a value of the scenario: pose.sigma_m=0.01, antennas.mobile.range_m=5, "
                  "'antennas.port_*.transmit_power_dbm=27' (* and ? match names), "
                  "world.path=FILE. Can be given several times")
      ->take_all()
      ->allow_extra_args(false);
  command
      .add_option("--without", without,
                  "Leave out an antenna, or all whose names match: 'dock_2_*'. Can be given "
                  "several times")
      ->take_all()
      ->allow_extra_args(false);
}

std::vector<Override> overrides_in(const std::vector<std::string>& settings) {
  std::vector<Override> overrides;
  overrides.reserve(settings.size());
  for (const std::string& setting : settings) overrides.push_back(parse_override(setting));
  return overrides;
}

ScenarioWithWorld load(const ScenarioArguments& arguments, Diagnostics& diagnostics) {
  suggest_shared_file(arguments.scenario);
  ScenarioWithWorld loaded = load_scenario_with_world(
      arguments.scenario, overrides_in(arguments.settings), diagnostics, arguments.world);
  take_antennas_away(arguments.without, loaded.scenario);
  return loaded;
}

std::string folder_name(const std::string& name) {
  std::string folder;
  for (const char character : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(character)) != 0 ||
                       character == '-' || character == '_' || character == '.';
    folder += plain ? character : '_';
  }
  if (folder.find_first_not_of('.') == std::string::npos) folder += '_';
  return folder;
}

const AntennaSpec& antenna_named(const std::string& command, const Scenario& scenario,
                                 const std::string& name) {
  std::vector<std::string> names;
  for (const AntennaSpec& antenna : scenario.antennas) names.push_back(antenna.parameters.name);
  return scenario.antennas[find_name(command, "antenna", name, names)];
}

std::vector<std::size_t> antennas_matching(const std::string& command, const Scenario& scenario,
                                           const std::vector<std::string>& patterns) {
  std::vector<char> chosen(scenario.antennas.size(), patterns.empty() ? 1 : 0);
  for (const std::string& pattern : patterns) {
    if (!is_pattern(pattern)) {
      chosen[static_cast<std::size_t>(&antenna_named(command, scenario, pattern) -
                                      scenario.antennas.data())] = 1;
      continue;
    }
    bool any = false;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      if (!matches(pattern, scenario.antennas[i].parameters.name)) continue;
      chosen[i] = 1;
      any = true;
    }
    if (!any) throw Error(fmt::format("{}: --antenna {}: matches no antenna", command, pattern));
  }
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (chosen[i] != 0) indices.push_back(i);
  }
  return indices;
}

const TagSpec& tag_named(const std::string& command, const Scenario& scenario,
                         const std::string& id) {
  std::vector<std::string> names;
  for (const TagSpec& tag : scenario.tags) names.push_back(tag.id);
  return scenario.tags[find_name(command, "tag", id, names)];
}

}  // namespace tagfield
