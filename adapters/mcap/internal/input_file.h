// SPDX-License-Identifier: Apache-2.0
/// @file
/// A file that is read in pieces, anywhere.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace tagfield::mcap_internal {

class InputFile {
 public:
  /// Throws Error if there is none, or it can't be read.
  explicit InputFile(std::string path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// Bytes that are within size(), until the next call. Throws Error if they can't be read.
  std::string_view view(std::uint64_t offset, std::uint64_t length);

  /// The CRC32 of bytes that are within size(), however many.
  std::uint32_t crc(std::uint64_t offset, std::uint64_t length);

 private:
  std::string path_;
  int file_;
  std::uint64_t size_ = 0;
  std::uint64_t window_offset_ = 0;
  std::string window_;  ///< More than was asked for, as most is read on and on.
};

}  // namespace tagfield::mcap_internal
