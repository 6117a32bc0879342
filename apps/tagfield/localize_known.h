// SPDX-License-Identifier: Apache-2.0
/// @file
/// What the command line of `localize` says to be known beforehand.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/tagfield/localize.h"
#include "tagfield/files/read_overview.h"
#include "tagfield/localization/problem.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Adds the options for heights, reference tags, offsets and the error of the poses.
void add_known_options(CLI::App& command, LocalizeArguments& arguments);

/// Replaces in `known` what the command line says of heights, reference tags, offsets and
/// polarization. Throws Error on an offset of an antenna that has no reads.
void take_known(const LocalizeArguments& arguments, const ReadOverview& reads,
                KnownBeforehand& known);

/// What is known of the error of poses of that name ("true", "odometry", "given", …): those of a
/// bag are the robot's own, whatever the scenario simulates.
std::optional<PoseErrorModel> pose_error_of(const LocalizeArguments& arguments,
                                            const Scenario* scenario, const std::string& poses);

/// Warns of options that say what is known, where `method` or poses of that name make no use of it.
void warn_of_unused_options(const LocalizeArguments& arguments, const Method& method,
                            const std::string& poses, Diagnostics& diagnostics);

/// Likewise of the map that they are on; none where nothing is told, and for true poses.
std::optional<MapError> map_error_of(const LocalizeArguments& arguments, const std::string& poses);

/// How far surfaces of the known world may be off [m]; 0 in the folder of a run. Throws Error where
/// the command line says so and the method makes nothing of it.
double world_sigma_of(const LocalizeArguments& arguments, const std::string& method,
                      const KnownBeforehand& known);

}  // namespace tagfield
