// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where what comes with the program lies.
#pragma once

#include <filesystem>
#include <string>

namespace tagfield {

/// The folder `name` ("models", "profiles"): installed beside the program, or in the source tree.
std::filesystem::path shared_folder(const std::string& name);

}  // namespace tagfield
