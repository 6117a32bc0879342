// SPDX-License-Identifier: Apache-2.0
#include "adapters/mcap/internal/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "adapters/mcap/internal/records.h"
#include "tagfield/base/error.h"

namespace tagfield::mcap_internal {
namespace {

constexpr std::uint64_t kWindowBytes = 1U << 20U;

[[noreturn]] void fail_to_read(const std::string& path) {
  fail({path, 0}, fmt::format("can't be read: {}", std::strerror(errno)));
}

/// Size of a regular file.
std::uint64_t size_of(int file, const std::string& path) {
  struct stat status {};
  if (::fstat(file, &status) != 0) fail_to_read(path);
  if (!S_ISREG(status.st_mode)) fail({path, 0}, "is a folder, a device or a pipe, expected a file");
  return static_cast<std::uint64_t>(status.st_size);
}

void read_fully(int file, const std::string& path, std::uint64_t offset, std::string& bytes) {
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t count = ::pread(file, bytes.data() + filled, bytes.size() - filled,
                                  static_cast<off_t>(offset + filled));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail_to_read(path);
    if (count == 0) fail({path, 0}, "has become shorter while it was read");
    filled += static_cast<std::size_t>(count);
  }
}

}  // namespace

InputFile::InputFile(std::string path)
    : path_(std::move(path)), file_(::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  if (file_ < 0 && (errno == ENOENT || errno == ENOTDIR)) fail({path_, 0}, "no such file");
  if (file_ < 0) fail_to_read(path_);
  try {
    size_ = size_of(file_, path_);
  } catch (...) {
    ::close(file_);
    throw;
  }
}

InputFile::~InputFile() { ::close(file_); }

std::string_view InputFile::view(std::uint64_t offset, std::uint64_t length) {
  if (offset < window_offset_ || offset + length > window_offset_ + window_.size()) {
    std::string window = std::exchange(window_, {});
    window.resize(std::min(std::max(length, kWindowBytes), size_ - offset));
    read_fully(file_, path_, offset, window);
    window_ = std::move(window);
    window_offset_ = offset;
  }
  return std::string_view(window_).substr(offset - window_offset_, length);
}

std::uint32_t InputFile::crc(std::uint64_t offset, std::uint64_t length) {
  std::uint32_t crc = 0;
  for (const std::uint64_t end = offset + length; offset < end; offset += kWindowBytes) {
    crc = crc_of(view(offset, std::min(kWindowBytes, end - offset)), crc);
  }
  return crc;
}

}  // namespace tagfield::mcap_internal
