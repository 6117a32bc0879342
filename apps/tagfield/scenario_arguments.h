// SPDX-License-Identifier: Apache-2.0
/// @file
/// What commands that look into a scenario have in common.
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
  std::vector<std::string> without{};  ///< Names of antennas to leave out, or patterns.
  WorldOptions world{};
};

/// Adds --skip-missing and --allow-outside.
void add_world_options(CLI::App& command, WorldOptions& options);

/// Adds --json: what a command prints then is what it writes as `file`.
void add_json_option(CLI::App& command, bool& as_json, const std::string& file);

/// Adds SCENARIO, --set, --without, --seed and the world's options.
void add_scenario_options(CLI::App& command, ScenarioArguments& arguments);

/// Adds --set and --without.
void add_change_options(CLI::App& command, std::vector<std::string>& settings,
                        std::vector<std::string>& without);

/// What --set was given, each KEY=VALUE. Throws Error on what is not.
std::vector<Override> overrides_in(const std::vector<std::string>& settings);

/// "" for what fits a seed's 64 bits; CLI11 by itself would bend -1 and 1e30 until they do.
std::string fault_of_seed(const std::string& word);

/// The scenario with its settings and its world.
ScenarioWithWorld load(const ScenarioArguments& arguments, Diagnostics& diagnostics);

/// A scenario's name as a folder's: whatever a shell would stumble over becomes '_'.
std::string folder_name(const std::string& name);

/// The antenna of this name; with "" the only one. Throws Error "COMMAND: …" with those there are.
const AntennaSpec& antenna_named(const std::string& command, const Scenario& scenario,
                                 const std::string& name);
/// Indices of the antennas whose names match one of `patterns`, in their order; of all where there
/// are no patterns. Throws Error "COMMAND: …" where one matches none.
std::vector<std::size_t> antennas_matching(const std::string& command, const Scenario& scenario,
                                           const std::vector<std::string>& patterns);
/// Likewise.
const TagSpec& tag_named(const std::string& command, const Scenario& scenario,
                         const std::string& id);

}  // namespace tagfield
