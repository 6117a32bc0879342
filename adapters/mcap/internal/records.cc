// SPDX-License-Identifier: Apache-2.0
#include "adapters/mcap/internal/records.h"

#include <fmt/format.h>
#include <zlib.h>

#include "tagfield/base/error.h"

namespace tagfield::mcap_internal {

std::uint32_t crc_of(std::string_view bytes, std::uint32_t before) {
  const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
  return static_cast<std::uint32_t>(crc32_z(before, data, bytes.size()));
}

void put_text(std::string& out, std::string_view text) {
  if (text.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(fmt::format("MCAP can't hold a text of {} bytes, 4 GB at most", text.size()));
  }
  put(out, static_cast<std::uint32_t>(text.size()));
  out += text;
}

void put_record(std::string& out, Op op, std::string_view content) {
  put(out, static_cast<std::uint8_t>(op));
  put(out, std::uint64_t{content.size()});
  out += content;
}

std::string schema_record(std::uint16_t id, const McapSchema& schema) {
  std::string content;
  put(content, id);
  for (const std::string* text : {&schema.name, &schema.encoding, &schema.text}) {
    put_text(content, *text);
  }
  std::string record;
  put_record(record, Op::kSchema, content);
  return record;
}

std::string channel_record(McapChannelId id, const McapChannel& channel, std::uint16_t schema) {
  std::string entries;
  for (const auto& [key, value] : channel.metadata) {
    put_text(entries, key);
    put_text(entries, value);
  }
  std::string content;
  put(content, id);
  put(content, schema);
  put_text(content, channel.topic);
  put_text(content, channel.message_encoding);
  put_text(content, entries);
  std::string record;
  put_record(record, Op::kChannel, content);
  return record;
}

void put_message(std::string& out, const McapMessage& message) {
  put(out, static_cast<std::uint8_t>(Op::kMessage));
  put(out, std::uint64_t{kMessageHeadBytes + message.bytes.size()});
  put(out, message.channel);
  put(out, message.sequence);
  put(out, message.log_time_ns);
  put(out, message.publish_time_ns);
  out += message.bytes;
}

std::string_view Fields::bytes(std::uint64_t count) {
  if (count > rest_.size()) {
    is_whole_ = false;
    rest_ = {};
    return {};
  }
  const std::string_view front = rest_.substr(0, count);
  rest_.remove_prefix(count);
  return front;
}

std::optional<Record> take_record(std::string_view& bytes) {
  Fields fields(bytes);
  const auto op = static_cast<Op>(fields.number<std::uint8_t>());
  const std::string_view content = fields.bytes(fields.number<std::uint64_t>());
  if (!fields.is_whole()) return std::nullopt;
  bytes = fields.rest();
  return Record{op, content};
}

std::optional<SchemaFields> schema_in(std::string_view content) {
  Fields fields(content);
  SchemaFields found;
  found.id = fields.number<std::uint16_t>();
  for (std::string* text : {&found.schema.name, &found.schema.encoding, &found.schema.text}) {
    *text = fields.text();
  }
  return fields.is_whole() ? std::optional(std::move(found)) : std::nullopt;
}

std::optional<ChannelFields> channel_in(std::string_view content) {
  Fields fields(content);
  ChannelFields found;
  found.id = fields.number<McapChannelId>();
  found.schema = fields.number<std::uint16_t>();
  found.channel.topic = fields.text();
  found.channel.message_encoding = fields.text();
  Fields entries(fields.text());
  while (!entries.rest().empty()) {
    std::string key(entries.text());
    found.channel.metadata.insert_or_assign(std::move(key), std::string(entries.text()));
  }
  return fields.is_whole() && entries.is_whole() ? std::optional(std::move(found)) : std::nullopt;
}

std::optional<McapMessage> message_in(std::string_view content) {
  Fields fields(content);
  McapMessage message;
  message.channel = fields.number<McapChannelId>();
  message.sequence = fields.number<std::uint32_t>();
  message.log_time_ns = fields.number<std::uint64_t>();
  message.publish_time_ns = fields.number<std::uint64_t>();
  message.bytes = fields.rest();
  return fields.is_whole() ? std::optional(message) : std::nullopt;
}

}  // namespace tagfield::mcap_internal
