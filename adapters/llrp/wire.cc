// SPDX-License-Identifier: Apache-2.0
#include "adapters/llrp/wire.h"

#include <fmt/format.h>

#include <algorithm>

namespace tagfield::llrp {
namespace {

constexpr std::uint16_t kCustom = 1023;
constexpr unsigned kVersion = 1;

/// Number of bytes after the type for parameters of fixed length (§16.1.2); none for others.
std::optional<std::size_t> fixed_size(unsigned type) {
  switch (type) {
    case 1:
    case 7:
    case 8:
    case 10:
    case 11:
    case 12:
    case 14:
    case 15:
    case 17:
      return 2;
    case 2:
    case 3:
    case 4:
    case 5:
      return 8;
    case 6:
      return 1;
    case 9:
    case 16:
    case 18:
      return 4;
    case 13:
      return 12;
    default:
      return std::nullopt;
  }
}

std::uint64_t number_at(const std::uint8_t* bytes, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) value = value << 8U | bytes[i];
  return value;
}

}  // namespace

std::uint64_t ByteReader::number(std::size_t size) {
  const ByteReader taken = part(size);
  return number_at(taken.begin_, size);
}

ByteReader ByteReader::part(std::size_t size) {
  if (size > left_) {
    throw Fault(Status::kParameterError,
                fmt::format("it ends where {} more bytes were expected", size - left_));
  }
  const ByteReader taken(begin_, size);
  begin_ += size;
  left_ -= size;
  return taken;
}

void ByteReader::require_end() const {
  if (left_ == 0) return;
  throw Fault(Status::kParameterError, fmt::format("{} bytes follow its end", left_));
}

Bytes ByteReader::bytes(std::size_t size) {
  const ByteReader taken = part(size);
  return {taken.begin_, taken.begin_ + size};
}

std::vector<std::uint16_t> ByteReader::u16_list() {
  const std::uint16_t count = u16();
  ByteReader taken = part(std::size_t{count} * 2);
  std::vector<std::uint16_t> values;
  values.reserve(count);
  for (std::uint16_t i = 0; i < count; ++i) values.push_back(taken.u16());
  return values;
}

ByteReader::Bits ByteReader::bits() {
  Bits read;
  read.count = u16();
  read.bytes = bytes((std::size_t{read.count} + 7) / 8);
  return read;
}

std::vector<Parameter> parameters_of(ByteReader reader) {
  std::vector<Parameter> all;
  while (reader.left() > 0) {
    ByteReader start = reader;
    const std::uint8_t first = reader.u8();
    std::size_t header = 1;
    unsigned type = first & 0x7fU;
    std::size_t size = 0;
    if ((first & 0x80U) != 0) {
      const auto fixed = fixed_size(type);
      if (!fixed) {
        throw Fault(Status::kUnexpectedParameter, fmt::format("there is no parameter {}", type));
      }
      size = *fixed;
    } else {
      type = (first & 0x03U) << 8U | reader.u8();
      const std::uint16_t length = reader.u16();
      header = 4;
      if (length < header) {
        throw Fault(Status::kParameterError,
                    fmt::format("parameter {} can't be {} bytes long", type, length));
      }
      size = length - header;
    }
    ByteReader content = reader.part(size);
    all.push_back({static_cast<std::uint16_t>(type), content, start.bytes(header + size)});
  }
  return all;
}

std::optional<Parameter> find(const std::vector<Parameter>& all, std::uint16_t type) {
  std::optional<Parameter> found;
  for (const Parameter& parameter : all) {
    if (parameter.type != type) continue;
    if (found) {
      throw Fault(Status::kDuplicateParameter, fmt::format("parameter {} is there twice", type));
    }
    found = parameter;
  }
  return found;
}

Parameter require(const std::vector<Parameter>& all, std::uint16_t type) {
  const auto found = find(all, type);
  if (!found) throw Fault(Status::kMissingParameter, fmt::format("parameter {} is missing", type));
  return *found;
}

void require_known(const std::vector<Parameter>& all, std::initializer_list<std::uint16_t> known) {
  for (const Parameter& parameter : all) {
    if (parameter.type == kCustom) continue;
    if (std::find(known.begin(), known.end(), parameter.type) == known.end()) {
      throw Fault(Status::kUnexpectedParameter,
                  fmt::format("parameter {} does not belong here", parameter.type));
    }
  }
}

void ByteWriter::number(std::uint64_t value, std::size_t size) {
  for (std::size_t i = size; i-- > 0;) {
    bytes_.push_back(static_cast<std::uint8_t>(value >> (8U * i)));
  }
}

void ByteWriter::bytes(const Bytes& bytes) {
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

void ByteWriter::text(std::string_view text) {
  u16(static_cast<std::uint16_t>(text.size()));
  bytes_.insert(bytes_.end(), text.begin(), text.end());
}

void ByteWriter::parameter(std::uint16_t type, const std::function<void()>& write) {
  const std::size_t begin = bytes_.size();
  u16(type);
  u16(0);
  write();
  const std::size_t length = bytes_.size() - begin;
  bytes_[begin + 2] = static_cast<std::uint8_t>(length >> 8U);
  bytes_[begin + 3] = static_cast<std::uint8_t>(length);
}

void ByteWriter::custom(std::uint32_t vendor, std::uint32_t subtype,
                        const std::function<void()>& write) {
  parameter(kCustom, [&] {
    u32(vendor);
    u32(subtype);
    write();
  });
}

std::uint32_t id_in(const Message& message) {
  ByteReader body(message.body);
  const std::uint32_t id = body.u32();
  body.require_end();
  return id;
}

Parameter only_parameter(const Message& message, std::uint16_t type) {
  const std::vector<Parameter> all = parameters_of(ByteReader(message.body));
  Parameter found = require(all, type);
  require_known(all, {type});
  return found;
}

Bytes to_bytes(const Message& message) {
  ByteWriter writer;
  writer.u16(static_cast<std::uint16_t>(kVersion << 10U | message.type));
  writer.u32(static_cast<std::uint32_t>(kHeaderSize + message.body.size()));
  writer.u32(message.id);
  writer.bytes(message.body);
  return writer.written();
}

std::size_t length_in(const std::uint8_t* header) {
  const unsigned version = header[0] >> 2U & 0x07U;
  const std::size_t length = number_at(header + 2, 4);
  if (length < kHeaderSize || length > kMaxMessage) {
    throw Fault(Status::kInvalid, fmt::format("a message can't be {} bytes long", length));
  }
  if (version != kVersion) {
    throw Fault(Status::kUnsupportedVersion,
                fmt::format("version {} is not supported, only 1 (LLRP 1.0.1)", version));
  }
  return length;
}

Message message_of(const Bytes& bytes) {
  Message message;
  message.type = static_cast<std::uint16_t>(number_at(bytes.data(), 2) & 0x3ffU);
  message.id = static_cast<std::uint32_t>(number_at(bytes.data() + 6, 4));
  message.body.assign(bytes.begin() + kHeaderSize, bytes.end());
  return message;
}

}  // namespace tagfield::llrp
