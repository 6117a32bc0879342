// SPDX-License-Identifier: Apache-2.0
/// @file
/// The steps of writing a file. Each throws Error that names the file.
#pragma once

#include <filesystem>
#include <string>

namespace tagfield::files_internal {

/// Writes a file that nobody uses yet, through to the disk; `named` is its path in error messages.
void write_through(const std::filesystem::path& path, const std::string& text,
                   const std::filesystem::path& named);

void rename_over(const std::filesystem::path& from, const std::filesystem::path& to);

/// Creates a folder and its parents if necessary.
void make_folder(const std::filesystem::path& folder);

/// Waits until renames in a folder are on the disk; as far as the file system supports it.
void sync_folder(const std::filesystem::path& folder);

}  // namespace tagfield::files_internal
