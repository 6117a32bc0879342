// SPDX-License-Identifier: Apache-2.0
/// @file
/// The tables that `tagfield localize` writes.
#pragma once

#include <optional>
#include <string>

#include "apps/tagfield/recording.h"
#include "apps/tagfield/scenario_arguments.h"
#include "tagfield/experiment/odometry_csv.h"
#include "tagfield/files/staged_folder.h"
#include "tagfield/localization/locate.h"

namespace tagfield {

bool is_empty(const Truth& truth);

/// Adds reads, poses, estimates, truth, and what was known beforehand. Reads that don't fit in
/// memory are read again and written as they come.
void stage_localization(const LoadedRecording& recording,
                        const std::optional<ScenarioWithWorld>& loaded,
                        const LocalizationOptions& options, const LocalizationResult& result,
                        const OdometryByAntenna& odometry, StagedFolder& folder);

/// Keeps the run's files in `out` that can't be recreated without a scenario and are not staged
/// already.
void keep_of_this_run(const std::string& out, StagedFolder& folder);

}  // namespace tagfield
