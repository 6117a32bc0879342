// SPDX-License-Identifier: Apache-2.0
/// @file
/// Prior knowledge on the command line of `localize`.
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

/// Reads the files of --tag-heights and --reference, once, as they may be pipes.
KnownTables known_tables(const LocalizeArguments& arguments);

/// Overrides in `known` the heights, reference tags, offsets and polarization that the command line
/// states. Throws Error on an offset of an antenna without reads.
void take_known(const LocalizeArguments& arguments, const ReadOverview& reads,
                KnownBeforehand& known);

/// Warns of tags in the files of --reference and --tag-heights that were never read, which are
/// usually typos: once for each file.
void warn_of_unread_tags(const LocalizeArguments& asked, const KnownTables& tables,
                         const ReadOverview& reads, Diagnostics& diagnostics);

/// Known error of poses of that name ("true", "odometry", "given", …): those of a bag are the
/// robot's own, whatever the scenario simulates.
std::optional<PoseErrorModel> pose_error_of(const LocalizeArguments& arguments,
                                            const Scenario* scenario, const std::string& poses);

/// Warns of options for prior knowledge that `method` or poses of that name don't use.
void warn_of_unused_options(const LocalizeArguments& arguments, const Method& method,
                            const std::string& poses, Diagnostics& diagnostics);

/// Same, for the map that the poses refer to; none if not given, and for true poses.
std::optional<MapError> map_error_of(const LocalizeArguments& arguments, const std::string& poses);

/// Standard deviation of surfaces in the known world [m]; 0 in a run's folder. Throws Error if the
/// command line states it and the method does not use it.
double world_sigma_of(const LocalizeArguments& arguments, const std::string& method,
                      const KnownBeforehand& known);

}  // namespace tagfield
