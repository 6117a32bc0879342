// SPDX-License-Identifier: Apache-2.0
/// @file
/// Whole files in and out. Nothing is ever left half-written: files are written beside their place
/// and renamed.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tagfield {

/// The whole of a file, or of what comes through a pipe. Throws Error if it is missing, a folder or
/// a device, holds more than `most_bytes`, or can't be read to its end.
std::string read_text_file(const std::string& path, std::size_t most_bytes = std::size_t{1} << 36U);

/// The same, some bytes after the other, to `take`. Throws Error as that does, and what `take`
/// throws.
void read_in_blocks(const std::string& path, const std::function<void(std::string_view)>& take);

/// Replaces or makes a file in one step; what a symbolic link points to, not the link. Devices and
/// pipes are written to as they are. What programs left beside it that were killed at this is
/// deleted. Throws Error if that can't be done.
void write_text_file(const std::string& path, const std::string& text);

/// Several, by path: none is replaced before all are written.
void write_text_files(const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace tagfield
