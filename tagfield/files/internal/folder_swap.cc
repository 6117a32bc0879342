// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/internal/folder_swap.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/files/internal/file_steps.h"
#include "tagfield/files/internal/folder_lock.h"
#include "tagfield/files/internal/own_files.h"

namespace tagfield::files_internal {
namespace fs = std::filesystem;
namespace {

/// Name prefix of temporary folders beside the results, followed by the process ID.
std::string beside_name(const fs::path& place) {
  return fmt::format(".{}.tagfield-", place.filename().string());
}

bool is_beside(const fs::path& place, const std::string& name) {
  const std::string start = beside_name(place);
  return name.size() > start.size() && name.compare(0, start.size(), start) == 0 &&
         name.find_first_not_of("0123456789", start.size()) == std::string::npos;
}

std::optional<struct stat> status_of(const fs::path& path) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0) return std::nullopt;
  return status;
}

/// Whether a file of ours is in or below that folder.
bool leads_to_own(const fs::path& name, const OwnFiles& own) {
  const auto next = own.upper_bound(name);
  return next != own.end() && is_at_or_below(*next, name);
}

/// Whether everything in a folder is on the same file system, and is ours or contains files of
/// ours.
bool holds_only(const fs::path& folder, const fs::path& staging, const OwnFiles& own) {
  const std::optional<struct stat> there = status_of(folder);
  std::error_code error;
  fs::recursive_directory_iterator entry(folder, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    const fs::path name = entry->path().lexically_relative(folder);
    const std::optional<struct stat> status = status_of(entry->path());
    if (!there || !status || status->st_dev != there->st_dev) return false;
    const bool is_folder = S_ISDIR(status->st_mode);
    if (entry->path() == staging) {
      entry.disable_recursion_pending();
    } else if (is_folder ? !leads_to_own(name, own) : own.count(name) == 0 && name != kOwnList) {
      return false;
    }
  }
  return !error;
}

/// Whether the process's current folder is in `place`; it would be deleted, and so would that of
/// the calling shell.
bool stands_in(const fs::path& place) {
  std::error_code error;
  const fs::path here = fs::current_path(error);
  return error || is_at_or_below(here, place);
}

/// Copies owner and permissions of the folder that it replaces.
bool made_alike(const fs::path& folder, const fs::path& staging) {
  const std::optional<struct stat> from = status_of(folder);
  const std::optional<struct stat> to = status_of(staging);
  if (!from || !to) return false;
  const bool is_alike = from->st_uid == to->st_uid && from->st_gid == to->st_gid;
  if (!is_alike && ::lchown(staging.c_str(), from->st_uid, from->st_gid) != 0) return false;
  return from->st_mode == to->st_mode || ::chmod(staging.c_str(), from->st_mode & 07777U) == 0;
}

/// Hard links `kept` into a folder; removes them again unless stay() is called.
class LinkedIn {
 public:
  LinkedIn(const fs::path& folder, fs::path staging, const OwnFiles& kept)
      : staging_(std::move(staging)) {
    for (const fs::path& name : kept) {
      std::error_code error;
      if (!fs::exists(fs::symlink_status(folder / name, error))) continue;
      make_folder((staging_ / name).parent_path());
      is_whole_ =
          ::linkat(AT_FDCWD, (folder / name).c_str(), AT_FDCWD, (staging_ / name).c_str(), 0) == 0;
      if (!is_whole_) return;
      links_.push_back(name);
    }
  }
  ~LinkedIn() {
    for (const fs::path& name : links_) ::unlink((staging_ / name).c_str());
  }
  LinkedIn(const LinkedIn&) = delete;
  LinkedIn& operator=(const LinkedIn&) = delete;
  [[nodiscard]] bool is_whole() const { return is_whole_; }
  void stay() { links_.clear(); }

 private:
  fs::path staging_;
  std::vector<fs::path> links_;
  bool is_whole_ = true;
};

void sync_folders_in(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::recursive_directory_iterator(folder, error)) {
    if (entry.symlink_status().type() == fs::file_type::directory) sync_folder(entry.path());
  }
  sync_folder(folder);
}

/// Deletes a folder that was at `place`, or was to be put there; files that others added to it at
/// the last moment are moved to `place`. Throws Error on failure.
void move_out_and_delete(const fs::path& gone, const fs::path& place) {
  const OwnFiles own = read_own_list(gone / kOwnList);
  std::error_code error;
  for (const fs::path& name : files_below(gone)) {
    if (own.count(name) > 0 || name == kOwnList) continue;
    if (fs::equivalent(gone / name, place / name, error)) {  // Kept in both.
      if (!fs::remove(gone / name, error)) return;
      continue;
    }
    if (fs::exists(fs::symlink_status(place / name, error))) return;
    make_folder((place / name).parent_path());
    fs::rename(gone / name, place / name, error);
    if (error) return;
  }
  delete_own_folder(gone);
}

/// Same, but ignores errors: the next result at that path may remove the rest.
void clear_away(const fs::path& gone, const fs::path& place) {
  try {
    move_out_and_delete(gone, place);
  } catch (const Error&) {
    return;
  }
}

bool exchanged(const fs::path& one, const fs::path& other) {
#ifdef RENAME_EXCHANGE
  return ::renameat2(AT_FDCWD, one.c_str(), AT_FDCWD, other.c_str(), RENAME_EXCHANGE) == 0;
#else
  return false;
#endif
}

}  // namespace

bool swap_in(const fs::path& folder, const fs::path& staging, const OwnFiles& own,
             const OwnFiles& kept) {
  std::error_code error;
  const fs::path place = fs::canonical(folder, error);
  if (error || !place.has_filename() || stands_in(place)) return false;
  if (!holds_only(folder, staging, own) || !made_alike(place, staging)) return false;
  LinkedIn links(folder, staging, kept);
  if (!links.is_whole()) return false;
  sync_folders_in(staging);
  const fs::path beside = place.parent_path() / fmt::format("{}{}", beside_name(place), getpid());
  fs::rename(staging, beside, error);
  if (error) return false;
  if (!exchanged(beside, place)) {
    fs::rename(beside, staging, error);
    return false;
  }
  links.stay();
  sync_folder(place.parent_path());
  clear_away(beside, place);
  return true;
}

void remove_swap_leftovers(const fs::path& folder) {
  std::error_code error;
  const fs::path place = fs::canonical(folder, error);
  if (error || !place.has_filename()) return;
  std::vector<fs::path> left;
  for (const auto& entry : fs::directory_iterator(place.parent_path(), error)) {
    if (is_beside(place, entry.path().filename().string())) left.push_back(entry.path());
  }
  for (const fs::path& path : left) {
    const bool is_ours = fs::is_directory(fs::symlink_status(path, error)) && is_own_folder(path);
    const int lock = is_ours ? locked(path, LOCK_EX | LOCK_NB) : -1;
    if (lock < 0) continue;
    clear_away(path, place);
    ::close(lock);
  }
}

}  // namespace tagfield::files_internal
