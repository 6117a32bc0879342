/// @file
/// Whole files in and out. Nothing is ever left half-written: files are written beside their place
/// and renamed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tagfield {

/// The whole of a file. Throws Error if it is missing, a folder, or can't be read.
std::string read_text_file(const std::string& path);

/// Replaces or makes a file in one step. Throws Error if that can't be done.
void write_text_file(const std::string& path, const std::string& text);

/// Several files that appear in a folder together. They gather in a hidden folder inside it and
/// are moved to their places by commit(); without it they vanish.
class StagedFolder {
 public:
  /// Makes `folder` and its parents if need be. Throws Error if it can't be made or written to.
  explicit StagedFolder(const std::filesystem::path& folder);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  /// Adds a file under its path relative to the folder.
  void add(const std::filesystem::path& name, const std::string& text);

  /// Moves all to their places, each replacing what was there, and deletes those of `stale` (files
  /// or folders, relative) that were not added.
  void commit(const std::vector<std::filesystem::path>& stale = {});

  /// Where the added files are until commit().
  [[nodiscard]] const std::filesystem::path& staging() const { return staging_; }

 private:
  void remove_stale(const std::filesystem::path& name);

  std::filesystem::path folder_;
  std::filesystem::path staging_;
  std::vector<std::filesystem::path> names_;
};

}  // namespace tagfield
