// SPDX-License-Identifier: Apache-2.0
/// @file
/// Locations of files that are shipped with the program.
#pragma once

#include <filesystem>
#include <string>

namespace tagfield {

/// The folder `name` ("models", "profiles"): installed beside the program, or in the source tree.
std::filesystem::path shared_folder(const std::string& name);

/// Throws Error if there is no file at `path`, but one of that name is shipped with the program,
/// such as "scenarios/conveyor.yaml" outside the source tree; the message states its location.
void suggest_shared_file(const std::string& path);

}  // namespace tagfield
