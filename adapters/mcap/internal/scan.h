// SPDX-License-Identifier: Apache-2.0
/// @file
/// What there is in an MCAP file, found by looking at all of it.
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

/// Where messages are: a chunk's content, or records on end outside of chunks.
struct Piece {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  bool is_chunk = false;
  std::uint64_t first_ns = 0;             ///< Earliest log time.
  std::vector<McapChannelId> channels{};  ///< Of its messages, by rising number.
};

struct Contents {
  std::string profile;
  std::map<std::uint16_t, std::shared_ptr<const McapSchema>> schemas;
  std::map<McapChannelId, McapChannel> channels;
  std::map<McapChannelId, std::uint64_t> counts;  ///< Of messages.
  std::vector<Piece> pieces;                      ///< In the order of the file; all are whole.
};

/// Warns of what is broken, with its byte, and leaves it out. Throws Error where the file can't be
/// read, or does not begin as one of MCAP.
Contents scan(InputFile& file, Diagnostics& diagnostics);

/// The records of a chunk, by its content. Gives null where all is right, else what is wrong.
const char* open_chunk(std::string_view content, std::string& records);

}  // namespace tagfield::mcap_internal
