// SPDX-License-Identifier: Apache-2.0
/// @file
/// A file with random access.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace tagfield::mcap_internal {

class InputFile {
 public:
  /// Throws Error if it does not exist or can't be read.
  explicit InputFile(std::string path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// Bytes within size(), valid until the next call. Throws Error if they can't be read.
  std::string_view view(std::uint64_t offset, std::uint64_t length);

  /// The CRC32 of any number of bytes within size().
  std::uint32_t crc(std::uint64_t offset, std::uint64_t length);

 private:
  std::string path_;
  int file_;
  std::uint64_t size_ = 0;
  std::uint64_t window_offset_ = 0;
  std::string window_;  ///< More than requested, as reading is mostly sequential.
};

}  // namespace tagfield::mcap_internal
