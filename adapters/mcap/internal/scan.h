// SPDX-License-Identifier: Apache-2.0
/// @file
/// Contents of an MCAP file, found by scanning all of it.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/mcap/internal/input_file.h"
#include "adapters/mcap/mcap_channel.h"
#include "tagfield/base/error.h"

namespace tagfield::mcap_internal {

/// A location of messages: a chunk's content, or a series of records outside of chunks.
struct Piece {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  bool is_chunk = false;
  std::uint64_t first_ns = 0;             ///< Earliest log time.
  std::vector<McapChannelId> channels{};  ///< Of its messages, in ascending order.
};

struct Contents {
  std::string profile;
  std::map<std::uint16_t, std::shared_ptr<const McapSchema>> schemas;
  std::map<McapChannelId, McapChannel> channels;
  std::map<McapChannelId, std::uint64_t> counts;  ///< Of messages.
  std::vector<Piece> pieces;                      ///< In file order; all are whole.
};

/// Skips damaged parts, with a warning that states the byte. Throws Error if the file can't be read
/// or does not begin like an MCAP file.
Contents scan(InputFile& file, Diagnostics& diagnostics);

/// Extracts the records of a chunk from its content. Returns null on success, else what is wrong.
const char* open_chunk(std::string_view content, std::string& records);

}  // namespace tagfield::mcap_internal
