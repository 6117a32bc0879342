// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/internal/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace tagfield::files_internal {
namespace fs = std::filesystem;
namespace {

bool is_locked(int file, int how) {
  while (::flock(file, how) != 0) {
    if (errno != EINTR) return false;
  }
  return true;
}

/// Whether the locked folder is still at that path: while waiting for the lock, it may have been
/// replaced by another.
bool still_stands_at(const fs::path& path, int file) {
  struct stat of_file {};
  struct stat of_path {};
  return ::fstat(file, &of_file) != 0 || ::stat(path.c_str(), &of_path) != 0 ||
         (of_file.st_ino == of_path.st_ino && of_file.st_dev == of_path.st_dev);
}

}  // namespace

int locked(const fs::path& folder, int how) {
  for (;;) {
    const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0) return -1;
    const bool has_lock = is_locked(file, how);
    if (has_lock && still_stands_at(folder, file)) return file;
    ::close(file);
    if (!has_lock) return -1;
  }
}

FolderLock::FolderLock(const fs::path& folder) : file_(locked(folder, LOCK_EX)) {}

FolderLock::~FolderLock() {
  if (file_ >= 0) ::close(file_);
}

}  // namespace tagfield::files_internal
