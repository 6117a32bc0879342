// SPDX-License-Identifier: Apache-2.0
/// @file
/// Records of MCAP files, made and taken apart: https://mcap.dev/spec, major version 0.
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
constexpr std::size_t kHeadBytes = 9;  ///< Of each record: what it is, and how long.
constexpr std::size_t kMessageHeadBytes = 22;
constexpr std::size_t kFooterBytes = 20;  ///< Without its head; never to be extended.

/// Continues the CRC32 of what came before.
std::uint32_t crc_of(std::string_view bytes, std::uint32_t before = 0);

// --- Making
// ---------------------------------------------------------------------------------------

/// Appends a number, little-endian.
template <std::unsigned_integral Number>
void put(std::string& out, Number number) {
  for (unsigned byte = 0; byte < sizeof(Number); ++byte) {
    out.push_back(static_cast<char>((std::uint64_t{number} >> (8 * byte)) & 0xFFU));
  }
}

/// Appends the length in 32 bits, then the bytes. Throws Error for those of more than 4 GB.
void put_text(std::string& out, std::string_view text);

/// Appends a whole record.
void put_record(std::string& out, Op op, std::string_view content);

std::string schema_record(std::uint16_t id, const McapSchema& schema);
std::string channel_record(McapChannelId id, const McapChannel& channel, std::uint16_t schema);
void put_message(std::string& out, const McapMessage& message);

// --- Taking apart
// ---------------------------------------------------------------------------------

/// Takes fields from the front of bytes that may be anything. What goes beyond their end is zero or
/// empty, as is all after it, and is_whole() says so.
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
  /// With its length in 32 bits before it.
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

/// The record at the front, taken away from there; none where it goes beyond the end.
std::optional<Record> take_record(std::string_view& bytes);

/// None of these where fields go beyond the end of the content.
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
