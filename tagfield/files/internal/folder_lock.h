// SPDX-License-Identifier: Apache-2.0
/// @file
/// Locks on folders, which end with the program that holds them, however it ends.
#pragma once

#include <filesystem>

namespace tagfield::files_internal {

/// Locks the folder that stands at that path by then, as flock(2) does. -1 where it could not be
/// had.
int locked(const std::filesystem::path& folder, int how);

/// One program at a time changes what is in a folder. Does without where a file system has no
/// locks.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_;
};

}  // namespace tagfield::files_internal
