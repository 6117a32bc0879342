// SPDX-License-Identifier: Apache-2.0
/// @file
/// The compressions of chunks that the format knows.
#pragma once

#include <string>
#include <string_view>

#include "adapters/mcap/mcap_writer.h"

namespace tagfield::mcap_internal {

/// As chunks name it: "", "lz4", "zstd".
std::string_view name_of(McapCompression compression);

/// Appends what the bytes become. Throws Error where the library can't have the memory.
void compress(McapCompression compression, std::string_view bytes, std::string& out);

/// Makes `out` the bytes before compression. Gives null where they are exactly `size`, else what is
/// wrong.
const char* decompress(std::string_view compression, std::string_view bytes, std::size_t size,
                       std::string& out);

}  // namespace tagfield::mcap_internal
