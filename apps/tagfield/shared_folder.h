// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where what comes with the program lies.
#pragma once

#include <filesystem>
#include <string>

namespace tagfield {

/// The folder `name` ("models", "profiles"): installed beside the program, or in the source tree.
std::filesystem::path shared_folder(const std::string& name);

/// Throws Error where no file is at `path`, but one of this name came with the program, as of
/// "scenarios/conveyor.yaml" outside the source tree; the message says where.
void suggest_shared_file(const std::string& path);

}  // namespace tagfield
