// SPDX-License-Identifier: Apache-2.0
/// @file
/// Which files of a folder Tagfield wrote, and what else is in it.
#pragma once

#include <filesystem>
#include <string>

#include "tagfield/files/staged_folder.h"

namespace tagfield::files_internal {

/// The list of them, in the folder.
inline constexpr const char* kOwnList = ".tagfield";
inline constexpr const char* kOwnListHeader =
    "# Files that Tagfield wrote here; it replaces no others.\n";

/// Whether that is a path that stays below the folder it is relative to.
bool is_within(const std::filesystem::path& name);

/// The text of a list, and what is in one; empty where it is missing. Throws Error for a list that
/// names places outside of its folder.
std::string own_list_of(const OwnFiles& files);
OwnFiles read_own_list(const std::filesystem::path& path);

/// Files below a folder, by path in it; links are not followed. Throws Error where it can't be
/// looked through to its end.
OwnFiles files_below(const std::filesystem::path& folder);

/// Whether a folder has such a list, or has lost it in delete_own_folder().
bool is_own_folder(const std::filesystem::path& folder);

/// Deletes it, its list last, so that another program goes on where one was killed; as well as it
/// can be done.
void delete_own_folder(const std::filesystem::path& folder);

/// Whether `name` is `place` or below it.
bool is_at_or_below(const std::filesystem::path& name, const std::filesystem::path& place);

}  // namespace tagfield::files_internal
