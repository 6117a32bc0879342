// SPDX-License-Identifier: Apache-2.0
/// @file
/// The format's compressions of chunks.
#pragma once

#include <string>
#include <string_view>

#include "adapters/mcap/mcap_writer.h"

namespace tagfield::mcap_internal {

/// Name in chunks: "", "lz4", "zstd".
std::string_view name_of(McapCompression compression);

/// Appends the compressed bytes. Throws Error if the library runs out of memory.
void compress(McapCompression compression, std::string_view bytes, std::string& out);

/// Replaces `out` with the decompressed bytes. Returns null if they are exactly `size`, else what
/// is wrong.
const char* decompress(std::string_view compression, std::string_view bytes, std::size_t size,
                       std::string& out);

}  // namespace tagfield::mcap_internal
