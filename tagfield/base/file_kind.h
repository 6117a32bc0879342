// SPDX-License-Identifier: Apache-2.0
/// @file
/// What is at a path, without exceptions.
#pragma once

#include <filesystem>

namespace tagfield {

/// Whether a file, a folder, or anything is at `path`, symbolic links followed. False also where
/// the system can't tell, as of a name too long for it: what is then asked of the file says why.
bool is_file(const std::filesystem::path& path);
bool is_folder(const std::filesystem::path& path);
bool is_there(const std::filesystem::path& path);

}  // namespace tagfield
