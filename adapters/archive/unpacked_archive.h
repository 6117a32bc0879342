// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tables out of archives, into a folder that goes when it is no longer needed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace tagfield {

/// What an archive may hold at most: it may be small and yet become endless.
struct ArchiveLimits {
  std::uint64_t bytes = std::uint64_t{1} << 32U;  ///< Of all its tables together.
  std::uint64_t entries = 100'000;
};

/// Whether the name is one of an archive of files (.tar, .tar.zst, .tar.gz, .tar.xz, .tgz) or of a
/// compressed table (.csv.zst, .csv.gz, .csv.xz).
bool is_archive(const std::string& path);

/// The tables (*.csv) of an archive, in a temporary folder that is deleted with this.
class UnpackedArchive {
 public:
  /// Throws Error "FILE: …" if it can't be read or holds more than `limits`, links, or names that
  /// lead out of it; and where Tagfield was built without libarchive.
  explicit UnpackedArchive(const std::string& path, const ArchiveLimits& limits = {});
  ~UnpackedArchive();
  UnpackedArchive(const UnpackedArchive&) = delete;
  UnpackedArchive& operator=(const UnpackedArchive&) = delete;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  /// The table that was compressed, or the one folder of the archive that has tables. Throws Error
  /// where there is none or more than one.
  [[nodiscard]] std::filesystem::path tables() const;

 private:
  std::string path_;
  std::filesystem::path folder_;
};

}  // namespace tagfield
