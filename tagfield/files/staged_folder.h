// SPDX-License-Identifier: Apache-2.0
/// @file
/// A folder of results, whose files appear together or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace tagfield {

/// A file that grows by whole lines: however the program ends, no line is truncated.
class GrowingFile {
 public:
  /// Creates the file; `named` is its path in error messages. Throws Error if it can't be created.
  GrowingFile(const std::filesystem::path& path, std::filesystem::path named);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  /// Buffer to which to append whole lines before sync().
  [[nodiscard]] std::string& text() { return text_; }
  /// Writes the appended text once there is enough of it. Throws Error if the disk is full.
  void sync() {
    if (text_.size() >= kWorthWriting) flush();
  }
  /// Writes all appended text.
  void flush();
  /// Same, and waits until it is on the disk.
  void finish();
  [[nodiscard]] bool has_written() const { return has_written_; }

 private:
  static constexpr std::size_t kWorthWriting = 1U << 16U;
  std::filesystem::path named_;
  int file_ = -1;
  bool has_written_ = false;
  std::string text_;
};

/// The files that Tagfield wrote to a folder, by relative path, as listed in its file `.tagfield`:
/// no others are replaced or deleted.
using OwnFiles = std::set<std::filesystem::path>;

/// Empty without the list. Throws Error for a list with paths outside the folder.
OwnFiles own_files(const std::filesystem::path& folder);

/// Completes a StagedFolder::commit() that was interrupted when its program was killed; to be
/// called before a folder of results is read. Does nothing if no commit was interrupted. Throws
/// Error if the folder can't be written to.
void finish_commit(const std::filesystem::path& folder);

/// Several files that appear in a folder together. They are collected in a folder `incomplete-PID`
/// inside it and moved to their final paths by commit(). Without commit() they vanish, unless a
/// file has grown so large that part of it was written to disk: the data so far then stay there
/// until the next commit() to the same folder.
class StagedFolder {
 public:
  /// Creates `folder` and its parents if necessary. Throws Error if it can't be created or written
  /// to, and for "-", which elsewhere means standard output.
  explicit StagedFolder(const std::filesystem::path& folder);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  /// Adds a file by its path relative to the folder. Throws Error if there is a file that Tagfield
  /// didn't write, or if the path leads through a symbolic link.
  void add(const std::filesystem::path& name, const std::string& text);

  /// Adds a file of any size, written by `write`. Throws Error as add() does, and exceptions of
  /// `write`.
  void add_written(const std::filesystem::path& name,
                   const std::function<void(GrowingFile&)>& write);

  /// Adds a copy of a file of any size. Throws Error as add() does, and if it can't be copied.
  void add_copy(const std::filesystem::path& name, const std::filesystem::path& from);

  /// Adds a file that grows until commit().
  std::shared_ptr<GrowingFile> grow(const std::filesystem::path& name);

  /// Keeps a file that the work stores in the folder besides its results, such as a log of
  /// progress. It stays there, and does not prevent commit() from being atomic.
  void keep(const std::filesystem::path& name);

  /// Location of the added files until commit(), including all text appended so far.
  [[nodiscard]] const std::filesystem::path& staging() const;

  /// Moves all files to their final paths, replacing existing ones, and deletes those of `stale`
  /// (files or folders, relative) that Tagfield wrote earlier and that were not added now. If the
  /// folder contains only Tagfield's files, it is replaced by a new folder atomically: observers
  /// see either the old files or the new ones. Otherwise files are moved one after the other, and
  /// if the program is killed meanwhile, finish_commit() moves the rest.
  void commit(const std::vector<std::filesystem::path>& stale = {});

 private:
  void require_free(const std::filesystem::path& name) const;

  std::filesystem::path folder_;
  std::filesystem::path staging_;
  int lock_ = -1;  ///< Held on `staging_` while it is in use.
  OwnFiles own_;   ///< Files of earlier commits.
  OwnFiles added_;
  OwnFiles kept_;  ///< Files passed to keep().
  std::vector<std::shared_ptr<GrowingFile>> growing_;
};

}  // namespace tagfield
