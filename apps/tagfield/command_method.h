// SPDX-License-Identifier: Apache-2.0
/// @file
/// A localization method that is a program, in whatever language.
#pragma once

#include <string>

#include "tagfield/localization/method.h"

namespace tagfield {

/// The method `name` that runs `command` by the shell, in the current folder, with a temporary
/// folder as its last argument. In that are reads.csv, antenna_poses.csv, and where they are known
/// tag_heights.csv and reference_tags.csv (docs/files.md); the program writes estimates.csv into it
/// (tagfield/report/estimates_csv.h). Locating throws Error where the program fails, with the last
/// line that it printed, and where what it wrote is no such table. Throws Error on a name that is
/// not of letters, digits, `_`, `-` and `.`.
Method command_method(const std::string& name, const std::string& command);

}  // namespace tagfield
