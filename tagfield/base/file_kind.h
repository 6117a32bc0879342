// SPDX-License-Identifier: Apache-2.0
/// @file
/// What exists at a path, without exceptions.
#pragma once

#include <filesystem>

namespace tagfield {

/// Whether a file, a folder, or anything exists at `path`, following symbolic links. Also false
/// where the system can't tell, e.g. for too long a name; a later access to the file then reports
/// why.
bool is_file(const std::filesystem::path& path);
bool is_folder(const std::filesystem::path& path);
bool is_there(const std::filesystem::path& path);

}  // namespace tagfield
