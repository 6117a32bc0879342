// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tables from archives, unpacked into a temporary folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace tagfield {

/// Limits on what is unpacked: even a small archive may unpack to endless data.
struct ArchiveLimits {
  std::uint64_t bytes = std::uint64_t{1} << 32U;  ///< Of all tables together.
  std::uint64_t entries = 100'000;
};

/// Whether the path names an archive of files (.tar, .tar.zst, .tar.gz, .tar.xz, .tgz) or a
/// compressed table (.csv.zst, .csv.gz, .csv.xz).
bool is_archive(const std::string& path);

/// The tables (*.csv) of an archive, in a temporary folder that the destructor deletes.
class UnpackedArchive {
 public:
  /// Throws Error "FILE: …" if the archive can't be read, exceeds `limits`, or contains links or
  /// names that lead out of it; and if Tagfield was built without libarchive.
  explicit UnpackedArchive(const std::string& path, const ArchiveLimits& limits = {});
  ~UnpackedArchive();
  UnpackedArchive(const UnpackedArchive&) = delete;
  UnpackedArchive& operator=(const UnpackedArchive&) = delete;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  /// The compressed table, or the archive's only folder with tables. Throws Error if there is none
  /// or more than one.
  [[nodiscard]] std::filesystem::path tables() const;

 private:
  std::string path_;
  std::filesystem::path folder_;
};

}  // namespace tagfield
