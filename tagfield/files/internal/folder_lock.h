// SPDX-License-Identifier: Apache-2.0
/// @file
/// Locks on folders, which are released with the program that holds them, however it ends.
#pragma once

#include <filesystem>

namespace tagfield::files_internal {

/// Locks the folder that is at that path once the lock is acquired, as flock(2) does. -1 on
/// failure.
int locked(const std::filesystem::path& folder, int how);

/// Ensures that only one program at a time changes a folder. Has no effect if the file system does
/// not support locks.
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
