// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tracking of which files in a folder were written by Tagfield.
#pragma once

#include <filesystem>
#include <string>

#include "tagfield/files/staged_folder.h"

namespace tagfield::files_internal {

/// The list of these files, in the folder.
inline constexpr const char* kOwnList = ".tagfield";
inline constexpr const char* kOwnListHeader =
    "# Files that Tagfield wrote here; it replaces no others.\n";

/// Whether the path stays below the folder that it is relative to.
bool is_within(const std::filesystem::path& name);

/// The text of a list, and the contents of one; empty if it is missing. Throws Error for a list
/// with paths outside of its folder.
std::string own_list_of(const OwnFiles& files);
OwnFiles read_own_list(const std::filesystem::path& path);

/// Files below a folder, by relative path; links are not followed. Throws Error if it can't be read
/// completely.
OwnFiles files_below(const std::filesystem::path& folder);

/// Whether a folder has such a list, or lost it in delete_own_folder().
bool is_own_folder(const std::filesystem::path& folder);

/// Deletes such a folder as far as possible, its list last, so that another program can continue if
/// this one is killed.
void delete_own_folder(const std::filesystem::path& folder);

/// Whether `name` is `place` or a path below it.
bool is_at_or_below(const std::filesystem::path& name, const std::filesystem::path& place);

}  // namespace tagfield::files_internal
