// SPDX-License-Identifier: Apache-2.0
/// @file
/// Checks for suspicious tables of reads and poses that are formally valid.
#pragma once

#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/files/read_overview.h"
#include "tagfield/poses/trajectory.h"

namespace tagfield {

/// Warns of rows that are not in chronological order (per antenna) and of carriers that can hardly
/// all be in hertz.
void warn_of_odd_reads(const std::string& file, const ReadOverview& reads,
                       Diagnostics& diagnostics);
/// Same, for the order of poses.
void warn_of_odd_poses(const std::string& file, const std::vector<AntennaPose>& poses,
                       Diagnostics& diagnostics);

/// "1200 reads of 10 tags by 1 antenna on 4 carriers from 865.7 to 867.5 MHz".
std::string summary_of_reads(const ReadOverview& reads);

}  // namespace tagfield
