// SPDX-License-Identifier: Apache-2.0
/// @file
/// The chunk that a writer is filling.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "adapters/mcap/internal/records.h"
#include "adapters/mcap/mcap_writer.h"

namespace tagfield::mcap_internal {

/// Earliest and latest; both zero if empty.
struct TimeRange {
  std::uint64_t first_ns = 0;
  std::uint64_t last_ns = 0;
  bool is_empty = true;

  void add(std::uint64_t time_ns);
};

struct OpenChunk {
  std::string records;
  std::map<McapChannelId, std::string> index;  ///< Log time and offset of each message.
  TimeRange times;

  void add(const McapMessage& message);
};

/// A chunk as written to the file.
struct ClosedChunk {
  std::string bytes;  ///< The chunk, then its message indexes.
  std::string index;  ///< Its record in the summary.
};

/// `offset`: of the chunk in the file.
ClosedChunk close_chunk(const OpenChunk& chunk, McapCompression compression, std::uint64_t offset);

}  // namespace tagfield::mcap_internal
