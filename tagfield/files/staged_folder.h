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
  /// The same, and waits until it is on the disk.
  void finish();
  [[nodiscard]] bool has_written() const { return has_written_; }

 private:
  static constexpr std::size_t kWorthWriting = 1U << 16U;
  std::filesystem::path named_;
  int file_ = -1;
  bool has_written_ = false;
  std::string text_;
};

/// The files that Tagfield wrote into a folder, by path in it, as its file `.tagfield` lists them:
/// no others are replaced or deleted.
using OwnFiles = std::set<std::filesystem::path>;

/// Empty without the list. Throws Error for a list that names places outside the folder.
OwnFiles own_files(const std::filesystem::path& folder);

/// Finishes what a program that was killed within StagedFolder::commit() had begun; to be called
/// before a folder of results is read. Does nothing where no commit was cut off. Throws Error if
/// the folder can't be written to.
void finish_commit(const std::filesystem::path& folder);

/// Several files that appear in a folder together. They gather in a folder `incomplete-PID` inside
/// it and are moved to their places by commit(). Without that they vanish, unless a file has grown
/// so much that it was written to: then what was told until then stays there, until the next
/// commit() into the same folder.
class StagedFolder {
 public:
  /// Makes `folder` and its parents if need be. Throws Error if it can't be made or written to, and
  /// on "-", which elsewhere is the standard output.
  explicit StagedFolder(const std::filesystem::path& folder);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  /// Adds a file under its path relative to the folder. Throws Error where one stands that Tagfield
  /// didn't write, and where the way there leads through a symbolic link.
  void add(const std::filesystem::path& name, const std::string& text);

  /// Adds a file, however large, that `write` fills. Throws Error as add() does, and what `write`
  /// throws.
  void add_written(const std::filesystem::path& name,
                   const std::function<void(GrowingFile&)>& write);

  /// Adds a copy of a file, however large. Throws Error as add() does, and where it can't be
  /// copied.
  void add_copy(const std::filesystem::path& name, const std::filesystem::path& from);

  /// Adds a file that grows until commit().
  std::shared_ptr<GrowingFile> grow(const std::filesystem::path& name);

  /// A file that the work keeps in the folder besides its results, such as a log of what is done.
  /// It stays there, and does not keep commit() from its one step.
  void keep(const std::filesystem::path& name);

  /// Where the added files are until commit(), all that was appended to them among it.
  [[nodiscard]] const std::filesystem::path& staging() const;

  /// Moves all to their places, each replacing what was there, and deletes those of `stale` (files
  /// or folders, relative) that Tagfield wrote earlier and that were not added now. Where the
  /// folder holds Tagfield's files alone, another folder takes its place in one step: whoever looks
  /// finds the old files or the new ones. Else they are moved one after the other, and a program
  /// killed meanwhile leaves the rest to finish_commit().
  void commit(const std::vector<std::filesystem::path>& stale = {});

 private:
  void require_free(const std::filesystem::path& name) const;

  std::filesystem::path folder_;
  std::filesystem::path staging_;
  int lock_ = -1;  ///< Held on `staging_` while it is in use.
  OwnFiles own_;   ///< Of earlier commits.
  OwnFiles added_;
  OwnFiles kept_;  ///< By keep().
  std::vector<std::shared_ptr<GrowingFile>> growing_;
};

}  // namespace tagfield
