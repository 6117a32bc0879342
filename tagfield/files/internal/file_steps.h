// SPDX-License-Identifier: Apache-2.0
/// @file
/// The steps that writing a file is made of. Each throws Error, and names the file.
#pragma once

#include <filesystem>
#include <string>

namespace tagfield::files_internal {

/// Writes a file that nobody looks at yet, through to the disk; `named` is its path in complaints.
void write_through(const std::filesystem::path& path, const std::string& text,
                   const std::filesystem::path& named);

void rename_over(const std::filesystem::path& from, const std::filesystem::path& to);

/// Makes a folder and its parents if need be.
void make_folder(const std::filesystem::path& folder);

/// Waits until what was renamed in a folder is on the disk; as well as the file system can.
void sync_folder(const std::filesystem::path& folder);

}  // namespace tagfield::files_internal
