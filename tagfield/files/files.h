// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reading and writing of whole files. Nothing is ever left half-written: files are written next to
/// their destination and renamed.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tagfield {

/// The whole content of a file or pipe. Throws Error if it is missing, a folder or a device,
/// exceeds `max_bytes`, or can't be read to its end.
std::string read_text_file(const std::string& path, std::size_t max_bytes = std::size_t{1} << 36U);

/// Same, but passes blocks of bytes to `take`. Throws Error as that does, and exceptions of `take`.
void read_in_blocks(const std::string& path, const std::function<void(std::string_view)>& take);

/// Replaces or creates a file atomically; for a symbolic link its target, not the link. Devices and
/// pipes are written to directly. Temporary files of programs that were killed while writing it are
/// deleted. Throws Error on failure.
void write_text_file(const std::string& path, const std::string& text);

/// Writes several files, by path: none is replaced before all are written.
void write_text_files(const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace tagfield
