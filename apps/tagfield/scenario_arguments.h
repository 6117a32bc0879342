// SPDX-License-Identifier: Apache-2.0
/// @file
/// Arguments shared by commands that examine a scenario.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/scenario/scenario_yaml.h"
#include "tagfield/sdf/load_world.h"

namespace tagfield {

struct ScenarioArguments {
  std::string scenario;
  std::vector<std::string> settings;
  std::optional<std::uint64_t> seed;
  std::vector<std::string> without{};  ///< Names or patterns of antennas to leave out.
  WorldOptions world{};
};

/// Adds --skip-missing and --allow-outside.
void add_world_options(CLI::App& command, WorldOptions& options);

/// Adds SCENARIO, --set, --without, --seed and the world's options.
void add_scenario_options(CLI::App& command, ScenarioArguments& arguments);

/// Adds --set and --without.
void add_change_options(CLI::App& command, std::vector<std::string>& settings,
                        std::vector<std::string>& without);

/// The arguments of --set, each KEY=VALUE. Throws Error otherwise.
std::vector<Override> overrides_in(const std::vector<std::string>& settings);

/// "" if the word fits in a seed's 64 bits, else what is wrong; CLI11 by itself would silently
/// convert -1 and 1e30.
std::string fault_of_seed(const std::string& word);

/// The scenario with its settings and its world.
ScenarioWithWorld load(const ScenarioArguments& arguments, Diagnostics& diagnostics);

/// A folder name for a scenario: characters that are special in shells become '_'.
std::string folder_name(const std::string& name);

/// The antenna with this name; with "" the only one. Throws Error "COMMAND: …", which lists the
/// antennas.
const AntennaSpec& antenna_named(const std::string& command, const Scenario& scenario,
                                 const std::string& name);
/// Indices of the antennas whose names match one of `patterns`, in ascending order; of all if there
/// are no patterns. Throws Error "COMMAND: …" if a pattern matches none.
std::vector<std::size_t> antennas_matching(const std::string& command, const Scenario& scenario,
                                           const std::vector<std::string>& patterns);
/// Same, for a tag.
const TagSpec& tag_named(const std::string& command, const Scenario& scenario,
                         const std::string& id);

}  // namespace tagfield
