// SPDX-License-Identifier: Apache-2.0
#include "tagfield/layout/internal/link_store.h"

#include <fmt/format.h>
#include <zlib.h>

#include <cstring>
#include <filesystem>

#include "tagfield/base/error.h"
#include "tagfield/base/random.h"
#include "tagfield/files/files.h"

namespace tagfield {
namespace {

constexpr const char* kMagic = "tagfield links 1\n";
constexpr std::size_t kMagicSize = 17;
constexpr std::size_t kHeadSize = kMagicSize + 2 * sizeof(std::uint64_t);

std::string file_of(const std::string& folder, const std::string& hash) {
  return (std::filesystem::path(folder) / (hash + ".links")).string();
}

void append(std::string& bytes, std::uint64_t number) {
  for (unsigned byte = 0; byte < 8; ++byte) {
    bytes += static_cast<char>((number >> (8U * byte)) & 0xFFU);
  }
}

std::uint64_t number_at(const std::string& bytes, std::size_t at) {
  std::uint64_t number = 0;
  for (unsigned byte = 0; byte < 8; ++byte) {
    number |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[at + byte]))
              << (8U * byte);
  }
  return number;
}

std::uint64_t checksum(const std::vector<std::int8_t>& column) {
  return crc32_z(0, reinterpret_cast<const Bytef*>(column.data()), column.size());
}

}  // namespace

std::string content_hash(const std::string& bytes) {
  return fmt::format("{:016x}{:016x}", stream_key(bytes), stream_key("tagfield" + bytes + "links"));
}

std::optional<std::vector<std::int8_t>> stored_column(const std::string& folder,
                                                      const std::string& hash, std::size_t size,
                                                      bool& damaged) {
  damaged = false;
  const std::string path = file_of(folder, hash);
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
  damaged = true;
  std::string bytes;
  try {
    bytes = read_text_file(path, kHeadSize + compressBound(size));
  } catch (const Error&) {
    return std::nullopt;
  }
  if (bytes.size() < kHeadSize || bytes.compare(0, kMagicSize, kMagic) != 0) return std::nullopt;
  if (number_at(bytes, kMagicSize) != size) return std::nullopt;
  std::vector<std::int8_t> column(size);
  uLongf length = size;
  const int result = uncompress(reinterpret_cast<Bytef*>(column.data()), &length,
                                reinterpret_cast<const Bytef*>(bytes.data()) + kHeadSize,
                                bytes.size() - kHeadSize);
  if (result != Z_OK || length != size) return std::nullopt;
  if (number_at(bytes, kMagicSize + 8) != checksum(column)) return std::nullopt;
  damaged = false;
  return column;
}

void store_column(const std::string& folder, const std::string& hash,
                  const std::vector<std::int8_t>& column) {
  std::string bytes = kMagic;
  append(bytes, column.size());
  append(bytes, checksum(column));
  uLongf length = compressBound(column.size());
  bytes.resize(kHeadSize + length);
  if (compress(reinterpret_cast<Bytef*>(bytes.data()) + kHeadSize, &length,
               reinterpret_cast<const Bytef*>(column.data()), column.size()) != Z_OK) {
    throw Error("links cannot be compressed: no memory");
  }
  bytes.resize(kHeadSize + length);
  write_text_file(file_of(folder, hash), bytes);
}

}  // namespace tagfield
