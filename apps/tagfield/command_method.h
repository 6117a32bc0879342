// SPDX-License-Identifier: Apache-2.0
/// @file
/// A localization method implemented by an external program, in any language.
#pragma once

#include <string>

#include "tagfield/localization/method.h"

namespace tagfield {

/// The method `name` that runs `command` in the shell, in the current folder, with a temporary
/// folder as its last argument. That folder contains reads.csv, antenna_poses.csv, and, if known,
/// tag_heights.csv and reference_tags.csv (docs/files.md); the program writes estimates.csv to it
/// (tagfield/report/estimates_csv.h). Locating throws Error if the program fails, with the last
/// line that it printed, or if its output is not such a table. Throws Error if the name does not
/// consist of letters, digits, `_`, `-` and `.`.
Method command_method(const std::string& name, const std::string& command);

}  // namespace tagfield
