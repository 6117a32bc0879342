// SPDX-License-Identifier: Apache-2.0
#include "adapters/archive/unpacked_archive.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <utility>

#include "adapters/archive/libarchive.h"
#include "tagfield/base/error.h"
#include "tagfield/base/file_kind.h"

namespace tagfield {
namespace fs = std::filesystem;
namespace {

struct FreeArchive {
  void operator()(archive* of) const { libarchive().read_free(of); }
};
using OpenArchive = std::unique_ptr<archive, FreeArchive>;

[[noreturn]] void fail_to_read(const std::string& path, archive* of) {
  const char* why = libarchive().error_string(of);
  fail({path, 0}, fmt::format("can't be unpacked: {}", why == nullptr ? "damaged" : why));
}

/// Only formats that libarchive reads itself: no external programs are started.
OpenArchive opened(const std::string& path) {
  OpenArchive of(libarchive().read_new());
  if (!of) throw Error(path + ": can't be read: out of memory");
  libarchive().read_support_filter_gzip(of.get());
  libarchive().read_support_filter_xz(of.get());
  libarchive().read_support_filter_zstd(of.get());
  if (path.find(".csv.") == std::string::npos) {
    libarchive().read_support_format_tar(of.get());
  } else {
    libarchive().read_support_format_raw(of.get());
  }
  constexpr std::size_t kBlock = 1U << 16U;
  if (libarchive().read_open_filename(of.get(), path.c_str(), kBlock) != ARCHIVE_OK) {
    fail_to_read(path, of.get());
  }
  return of;
}

fs::path new_folder() {
  std::string name = (fs::temp_directory_path() / "tagfield-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw Error(name + ": the folder can't be made");
  return name;
}

/// Deletes the folder unless it is kept.
class FolderUnderWay {
 public:
  FolderUnderWay() : folder_(new_folder()) {}
  ~FolderUnderWay() {
    std::error_code ignored;
    if (!folder_.empty()) fs::remove_all(folder_, ignored);
  }
  FolderUnderWay(const FolderUnderWay&) = delete;
  FolderUnderWay& operator=(const FolderUnderWay&) = delete;
  [[nodiscard]] const fs::path& path() const { return folder_; }
  fs::path keep() { return std::exchange(folder_, fs::path()); }

 private:
  fs::path folder_;
};

/// Unpacks one archive.
class Unpacking {
 public:
  Unpacking(const std::string& path, const ArchiveLimits& limits, const fs::path& folder)
      : path_(path), limits_(limits), folder_(folder), archive_(opened(path)) {}

  void run() {
    archive_entry* entry = nullptr;
    while (next(entry)) {
      require_compression();
      if (++entries_ > limits_.entries) refuse(fmt::format("more than {} files", limits_.entries));
      unpack(entry);
    }
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    fail({path_, 0}, fmt::format("holds {}: it is not unpacked", what));
  }

  bool next(archive_entry*& entry) {
    const int status = libarchive().read_next_header(archive_.get(), &entry);
    if (status == ARCHIVE_EOF) return false;
    if (status != ARCHIVE_OK) fail_to_read(path_, archive_.get());
    return true;
  }

  /// libarchive accepts any file as a compressed table; only if there are filters besides the last
  /// one, "none", is it really compressed.
  void require_compression() const {
    if (libarchive().format(archive_.get()) != ARCHIVE_FORMAT_RAW) return;
    if (libarchive().filter_count(archive_.get()) < 2) {
      fail({path_, 0}, "can't be unpacked: it is not compressed");
    }
  }

  /// Path to which to unpack the entry. Throws Error unless that is inside of the folder.
  [[nodiscard]] fs::path place_of(archive_entry* entry) const {
    if (libarchive().format(archive_.get()) == ARCHIVE_FORMAT_RAW) return fs::path(path_).stem();
    const char* name = libarchive().entry_pathname(entry);
    if (name == nullptr) refuse("a file without a name");
    fs::path place = fs::path(name).lexically_normal();
    if (place.empty() || place.is_absolute() || *place.begin() == "..") {
      refuse(fmt::format("'{}', which leads out of it", name));
    }
    return place;
  }

  void unpack(archive_entry* entry) {
    const fs::path place = place_of(entry);
    if (libarchive().entry_symlink(entry) != nullptr ||
        libarchive().entry_hardlink(entry) != nullptr) {
      refuse(fmt::format("the link '{}'", place.string()));
    }
    if (libarchive().entry_filetype(entry) == AE_IFDIR || place.extension() != ".csv") return;
    if (libarchive().entry_filetype(entry) != AE_IFREG) {
      refuse(fmt::format("'{}', which is not a file", place.string()));
    }
    const fs::path target = folder_ / place;
    fs::create_directories(target.parent_path());
    if (is_there(target)) refuse(fmt::format("'{}' twice", place.string()));
    write(target);
  }

  void write(const fs::path& target) {
    std::ofstream file(target, std::ios::binary);
    if (!file) fail({path_, 0}, fmt::format("can't be unpacked: {}", std::strerror(errno)));
    std::array<char, std::size_t{1} << 16U> block{};
    while (true) {
      const la_ssize_t count = libarchive().read_data(archive_.get(), block.data(), block.size());
      if (count < 0) fail_to_read(path_, archive_.get());
      if (count == 0) break;
      bytes_ += static_cast<std::uint64_t>(count);
      if (bytes_ > limits_.bytes) refuse(fmt::format("more than {} bytes", limits_.bytes));
      file.write(block.data(), count);
    }
    file.close();
    if (!file) fail({path_, 0}, fmt::format("can't be unpacked to {}", folder_.string()));
  }

  const std::string& path_;
  const ArchiveLimits& limits_;
  const fs::path& folder_;
  OpenArchive archive_;
  std::uint64_t entries_ = 0;
  std::uint64_t bytes_ = 0;
};

}  // namespace

UnpackedArchive::UnpackedArchive(const std::string& path, const ArchiveLimits& limits)
    : path_(path) {
  try {
    FolderUnderWay folder;
    Unpacking(path, limits, folder.path()).run();
    folder_ = folder.keep();
  } catch (const fs::filesystem_error& error) {
    fail({path, 0}, fmt::format("can't be unpacked: {}", error.code().message()));
  }
}

UnpackedArchive::~UnpackedArchive() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

}  // namespace tagfield
