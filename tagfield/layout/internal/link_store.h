// SPDX-License-Identifier: Apache-2.0
/// @file
/// Columns of a link matrix on disk, compressed, each under the hash of all its inputs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tagfield {

/// Hash of 32 hexadecimal digits.
std::string content_hash(const std::string& bytes);

/// A column of `size` bytes from `folder`; none if it is not there. Sets `damaged` if the file
/// exists but is incomplete.
std::optional<std::vector<std::int8_t>> stored_column(const std::string& folder,
                                                      const std::string& hash, std::size_t size,
                                                      bool& damaged);

/// Throws Error as write_text_file() does.
void store_column(const std::string& folder, const std::string& hash,
                  const std::vector<std::int8_t>& column);

}  // namespace tagfield
