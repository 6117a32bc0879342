// SPDX-License-Identifier: Apache-2.0
#include "adapters/mcap/internal/open_chunk.h"

#include <algorithm>

#include "adapters/mcap/internal/compression.h"

namespace tagfield::mcap_internal {
namespace {

void put_chunk(const OpenChunk& chunk, std::string_view compression, std::string_view compressed,
               std::string& out) {
  std::string head;
  put(head, chunk.times.first_ns);
  put(head, chunk.times.last_ns);
  put(head, std::uint64_t{chunk.records.size()});
  put(head, crc_of(chunk.records));
  put_text(head, compression);
  put(head, std::uint64_t{compressed.size()});
  put(out, static_cast<std::uint8_t>(Op::kChunk));
  put(out, std::uint64_t{head.size() + compressed.size()});
  out += head;
  out += compressed;
}

/// Appends the index of each channel; returns their offsets in the file, as a map from channels.
std::string put_message_indexes(const OpenChunk& chunk, std::uint64_t offset, std::string& out) {
  std::string places;
  for (const auto& [channel, entries] : chunk.index) {
    put(places, channel);
    put(places, offset + out.size());
    std::string content;
    put(content, channel);
    put_text(content, entries);
    put_record(out, Op::kMessageIndex, content);
  }
  return places;
}

}  // namespace

void TimeRange::add(std::uint64_t time_ns) {
  first_ns = is_empty ? time_ns : std::min(first_ns, time_ns);
  last_ns = std::max(last_ns, time_ns);
  is_empty = false;
}

void OpenChunk::add(const McapMessage& message) {
  std::string& entries = index[message.channel];
  put(entries, message.log_time_ns);
  put(entries, std::uint64_t{records.size()});
  times.add(message.log_time_ns);
  put_message(records, message);
}

ClosedChunk close_chunk(const OpenChunk& chunk, McapCompression compression, std::uint64_t offset) {
  std::string compressed;
  compress(compression, chunk.records, compressed);
  ClosedChunk closed;
  put_chunk(chunk, name_of(compression), compressed, closed.bytes);
  const std::size_t length = closed.bytes.size();
  const std::string places = put_message_indexes(chunk, offset, closed.bytes);
  std::string content;
  put(content, chunk.times.first_ns);
  put(content, chunk.times.last_ns);
  put(content, offset);
  put(content, std::uint64_t{length});
  put_text(content, places);
  put(content, std::uint64_t{closed.bytes.size() - length});
  put_text(content, name_of(compression));
  put(content, std::uint64_t{compressed.size()});
  put(content, std::uint64_t{chunk.records.size()});
  put_record(closed.index, Op::kChunkIndex, content);
  return closed;
}

}  // namespace tagfield::mcap_internal
