// SPDX-License-Identifier: Apache-2.0
/// @file
/// Entries of a folder.
#pragma once

#include <filesystem>
#include <vector>

namespace tagfield {

/// Sorted paths of all direct entries of a folder; empty if there is no folder. Throws Error if it
/// can't be read, which is not the same.
std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder);

}  // namespace tagfield
