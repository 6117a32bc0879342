/// @file
/// Whole files in and out. Nothing is ever left half-written: files are written beside their place
/// and renamed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace tagfield {

/// The whole of a file. Throws Error if it is missing, a folder, or can't be read.
std::string read_text_file(const std::string& path);

/// Replaces or makes a file in one step. Throws Error if that can't be done.
void write_text_file(const std::string& path, const std::string& text);

/// A file that grows by whole lines: whatever ends the program, no line is cut.
class GrowingFile {
 public:
  /// Makes the file; `named` is its path in complaints. Throws Error if it can't be made.
  GrowingFile(const std::filesystem::path& path, std::filesystem::path named);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  /// Where to append whole lines, before sync().
  [[nodiscard]] std::string& text() { return text_; }
  /// Writes what was appended once it is worth it. Throws Error if the disk is full.
  void sync() {
    if (text_.size() >= kWorthWriting) flush();
  }
  /// Writes all that was appended.
  void flush();
  [[nodiscard]] bool has_written() const { return has_written_; }

 private:
  static constexpr std::size_t kWorthWriting = 1U << 16U;
  std::filesystem::path named_;
  int file_ = -1;
  bool has_written_ = false;
  std::string text_;
};

/// Several files that appear in a folder together. They gather in a folder `incomplete-PID` inside
/// it and are moved to their places by commit(). Without that they vanish, unless a file has grown
/// so much that it was written to: then what was told until then stays there.
class StagedFolder {
 public:
  /// Makes `folder` and its parents if need be. Throws Error if it can't be made or written to.
  explicit StagedFolder(const std::filesystem::path& folder);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  /// Adds a file under its path relative to the folder.
  void add(const std::filesystem::path& name, const std::string& text);

  /// Adds a file that grows until commit().
  std::shared_ptr<GrowingFile> grow(const std::filesystem::path& name);

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
  std::vector<std::shared_ptr<GrowingFile>> growing_;
};

}  // namespace tagfield
