// SPDX-License-Identifier: Apache-2.0
/// @file
/// Writing and parsing of MCAP records: https://mcap.dev/spec, major version 0.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "adapters/mcap/mcap_channel.h"

namespace tagfield::mcap_internal {

enum class Op : std::uint8_t {
  kHeader = 1,
  kFooter,
  kSchema,
  kChannel,
  kMessage,
  kChunk,
  kMessageIndex,
  kChunkIndex,
  kAttachment,
  kAttachmentIndex,
  kStatistics,
  kMetadata,
  kMetadataIndex,
  kSummaryOffset,
  kDataEnd
};

/// Before the first record and after the last.
constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};
constexpr std::size_t kHeadBytes = 9;  ///< Header of each record: type and length.
constexpr std::size_t kMessageHeadBytes = 22;
constexpr std::size_t kFooterBytes = 20;  ///< Without its header; never to be extended.

/// Continues the CRC32 `before` of the preceding bytes.
std::uint32_t crc_of(std::string_view bytes, std::uint32_t before = 0);

// --- Writing ----------------------------------------------------------------------

/// Appends a number, little-endian.
template <std::unsigned_integral Number>
void put(std::string& out, Number number) {
  for (unsigned byte = 0; byte < sizeof(Number); ++byte) {
    out.push_back(static_cast<char>((std::uint64_t{number} >> (8 * byte)) & 0xFFU));
  }
}

/// Appends the length in 32 bits, then the bytes. Throws Error if they exceed 4 GB.
void put_text(std::string& out, std::string_view text);

/// Appends a whole record.
void put_record(std::string& out, Op op, std::string_view content);

std::string schema_record(std::uint16_t id, const McapSchema& schema);
std::string channel_record(McapChannelId id, const McapChannel& channel, std::uint16_t schema);
void put_message(std::string& out, const McapMessage& message);

// --- Parsing ----------------------------------------------------------------------

/// Parses fields from untrusted bytes. A field beyond the end is zero or empty, as are all after
/// it, and is_whole() is false.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : rest_(bytes) {}

  template <std::unsigned_integral Number>
  Number number() {
    std::uint64_t number = 0;
    unsigned shift = 0;
    for (const char byte : bytes(sizeof(Number))) {
      number |= std::uint64_t{static_cast<unsigned char>(byte)} << shift;
      shift += 8;
    }
    return static_cast<Number>(number);
  }
  std::string_view bytes(std::uint64_t count);
  /// Preceded by its length in 32 bits.
  std::string_view text() { return bytes(number<std::uint32_t>()); }
  [[nodiscard]] std::string_view rest() const { return rest_; }
  [[nodiscard]] bool is_whole() const { return is_whole_; }

 private:
  std::string_view rest_;
  bool is_whole_ = true;
};

struct Record {
  Op op = Op::kHeader;
  std::string_view content;
};

/// Removes the record at the front and returns it; none if it extends beyond the end.
std::optional<Record> take_record(std::string_view& bytes);

/// Parsers return none if fields extend beyond the end of the content.
struct SchemaFields {
  std::uint16_t id = 0;
  McapSchema schema;
};
std::optional<SchemaFields> schema_in(std::string_view content);

struct ChannelFields {
  McapChannelId id = 0;
  std::uint16_t schema = 0;  ///< 0 for none.
  McapChannel channel;       ///< Without its schema.
};
std::optional<ChannelFields> channel_in(std::string_view content);

std::optional<McapMessage> message_in(std::string_view content);

}  // namespace tagfield::mcap_internal
