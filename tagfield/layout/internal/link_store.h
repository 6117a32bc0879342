// SPDX-License-Identifier: Apache-2.0
/// @file
/// Columns of a link matrix on disk, compressed, each under the hash of all that it depends on.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tagfield {

/// Text of 32 hexadecimal digits that tells contents apart.
std::string content_hash(const std::string& bytes);

/// A column of `size` bytes from `folder`; none where it is not there. `damaged` is set where a
/// file is there that is not whole.
std::optional<std::vector<std::int8_t>> stored_column(const std::string& folder,
                                                      const std::string& hash, std::size_t size,
                                                      bool& damaged);

/// Throws Error as write_text_file() does.
void store_column(const std::string& folder, const std::string& hash,
                  const std::vector<std::int8_t>& column);

}  // namespace tagfield
