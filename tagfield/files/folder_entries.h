// SPDX-License-Identifier: Apache-2.0
/// @file
/// What is in a folder.
#pragma once

#include <filesystem>
#include <vector>

namespace tagfield {

/// Paths of all that is in a folder itself, sorted; nothing where there is no folder. Throws Error
/// where it can't be looked through, which is not the same.
std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder);

}  // namespace tagfield
