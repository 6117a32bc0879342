// SPDX-License-Identifier: Apache-2.0
/// @file
/// MCAP files byte by byte according to the tables of https://mcap.dev/spec, independent of the
/// code under test.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tagfield::mcap_test {

const std::string kMagic("\x89MCAP0\r\n", 8);

/// Little-endian number of `bytes` bytes.
inline std::string le(std::uint64_t number, int bytes) {
  std::string out;
  for (int byte = 0; byte < bytes; ++byte) {
    out += static_cast<char>(number & 0xFFU);
    number >>= 8U;
  }
  return out;
}

inline std::uint64_t number_at(std::string_view bytes, std::size_t at, int count) {
  std::uint64_t number = 0;
  for (int byte = 0; byte < count; ++byte) {
    const auto value = static_cast<unsigned char>(bytes.at(at + static_cast<std::size_t>(byte)));
    number |= std::uint64_t{value} << (8 * byte);
  }
  return number;
}

inline std::string text(const std::string& text) { return le(text.size(), 4) + text; }

inline std::string record(int op, const std::string& content) {
  return le(static_cast<std::uint64_t>(op), 1) + le(content.size(), 8) + content;
}

/// CRC-32 of ISO 3309, bit by bit.
inline std::uint32_t crc(std::string_view bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

inline std::string schema(int id, const std::string& name, const std::string& definition) {
  return record(
      3, le(static_cast<std::uint64_t>(id), 2) + text(name) + text("ros2msg") + text(definition));
}

inline std::string channel(int id, int schema, const std::string& topic) {
  return record(4, le(static_cast<std::uint64_t>(id), 2) +
                       le(static_cast<std::uint64_t>(schema), 2) + text(topic) + text("cdr") +
                       text(""));
}

inline std::string message(int channel, std::uint64_t log_time, const std::string& bytes) {
  return record(5, le(static_cast<std::uint64_t>(channel), 2) + le(7, 4) + le(log_time, 8) +
                       le(log_time, 8) + bytes);
}

/// `size`: the stated size before compression.
inline std::string chunk(const std::string& compression, const std::string& bytes,
                         std::uint64_t size, std::uint32_t crc_of_records) {
  return record(6, le(0, 16) + le(size, 8) + le(crc_of_records, 4) + text(compression) +
                       le(bytes.size(), 8) + bytes);
}

inline std::string chunk(const std::string& records) {
  return chunk("", records, records.size(), crc(records));
}

/// A file of these records, without a summary but with the CRC of the data.
inline std::string file_of(const std::string& records) {
  const std::string data = kMagic + record(1, text("") + text("")) + records;
  return data + record(15, le(crc(data), 4)) + record(2, le(0, 20)) + kMagic;
}

struct RecordThere {
  int op = 0;
  std::size_t offset = 0;  ///< Of its first byte in the scanned bytes.
  std::string content;

  [[nodiscard]] std::size_t length() const { return 9 + content.size(); }
};

/// All consecutive records from `at` to the end of `bytes`.
inline std::vector<RecordThere> records_in(std::string_view bytes, std::size_t at = 0) {
  std::vector<RecordThere> found;
  while (at < bytes.size()) {
    const std::uint64_t length = number_at(bytes, at + 1, 8);
    found.push_back(
        {static_cast<int>(number_at(bytes, at, 1)), at, std::string(bytes.substr(at + 9, length))});
    at += 9 + length;
  }
  return found;
}

/// All records of a file, without those in chunks.
inline std::vector<RecordThere> records_of_file(const std::string& file) {
  return records_in(std::string_view(file).substr(0, file.size() - kMagic.size()), kMagic.size());
}

}  // namespace tagfield::mcap_test
