// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/staged_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <exception>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

#include "tagfield/base/error.h"
#include "tagfield/files/files.h"
#include "tagfield/files/internal/file_steps.h"
#include "tagfield/files/internal/folder_lock.h"
#include "tagfield/files/internal/folder_swap.h"
#include "tagfield/files/internal/own_files.h"

namespace tagfield {
namespace fs = std::filesystem;
namespace {

using files_internal::delete_own_folder;
using files_internal::files_below;
using files_internal::FolderLock;
using files_internal::is_at_or_below;
using files_internal::is_own_folder;
using files_internal::is_within;
using files_internal::kOwnList;
using files_internal::kOwnListHeader;
using files_internal::locked;
using files_internal::make_folder;
using files_internal::own_list_of;
using files_internal::read_own_list;
using files_internal::rename_over;
using files_internal::sync_folder;
using files_internal::write_through;

constexpr const char* kCommitting = ".tagfield-commit";
constexpr const char* kIncomplete = "incomplete-";

/// Throws Error unless each parent folder of `name` is a folder or does not exist yet.
void require_way(const fs::path& folder, const fs::path& name) {
  fs::path way = folder;
  for (const fs::path& part : name.parent_path()) {
    way /= part;
    std::error_code error;
    const fs::file_status status = fs::symlink_status(way, error);
    if (!fs::exists(status)) return;
    if (fs::is_symlink(status)) {
      fail({way.string(), 0}, "is a symbolic link, expected a folder: results stay in theirs");
    }
    if (!fs::is_directory(status)) fail({way.string(), 0}, "is in the way of a folder");
  }
}

void remove_with_empty_parents(const fs::path& folder, const fs::path& name) {
  require_way(folder, name);
  std::error_code ignored;
  if (fs::is_directory(fs::symlink_status(folder / name, ignored))) return;
  fs::remove(folder / name, ignored);
  for (fs::path parent = name.parent_path(); !parent.empty(); parent = parent.parent_path()) {
    if (::rmdir((folder / parent).c_str()) != 0) return;
  }
}

/// Past the point of no return: moves everything in `.tagfield-commit` to its final path. Can be
/// interrupted anywhere and repeated.
void roll_forward(const fs::path& folder) {
  const fs::path committing = folder / kCommitting;
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(committing, error))) return;
  if (fs::exists(fs::symlink_status(committing / kOwnList, error))) {
    const OwnFiles before = read_own_list(folder / kOwnList);
    const OwnFiles after = read_own_list(committing / kOwnList);
    for (const fs::path& name : files_below(committing)) {
      if (name == kOwnList) continue;
      require_way(folder, name);
      make_folder((folder / name).parent_path());
      rename_over(committing / name, folder / name);
    }
    for (const fs::path& name : before) {
      if (after.count(name) == 0) remove_with_empty_parents(folder, name);
    }
    rename_over(committing / kOwnList, folder / kOwnList);
    sync_folder(folder);
  }
  if (files_below(committing).empty()) fs::remove_all(committing, error);
}

/// Commits non-atomically: if the program is killed meanwhile, others complete the commit.
void move_in(const fs::path& folder, const fs::path& staging) {
  rename_over(staging, folder / kCommitting);
  sync_folder(folder);
  roll_forward(folder);
}

/// Whether a folder has a name as given by make_staging().
bool is_staging(const std::string& name) {
  const std::size_t start = std::string_view(kIncomplete).size();
  return name.rfind(kIncomplete, 0) == 0 && name.size() > start &&
         name.find_first_not_of("0123456789.", start) == std::string::npos;
}

/// Deletes leftovers of killed runs: nobody holds their lock any more. Those that had not written
/// their list yet are empty; a folder of that name with other contents belongs to someone else.
void remove_abandoned(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const fs::path& place = entry.path();
    if (!is_staging(place.filename().string())) continue;
    if (!fs::is_directory(fs::symlink_status(place, error))) continue;
    const int lock = locked(place, LOCK_EX | LOCK_NB);
    if (lock < 0) continue;
    if (is_own_folder(place)) delete_own_folder(place);
    ::close(lock);
  }
}

/// Creates `incomplete-PID`, or `incomplete-PID.2` if an earlier program left the former.
fs::path make_staging(const fs::path& folder) {
  for (int attempt = 1; attempt < 1000; ++attempt) {
    fs::path staging = folder / fmt::format("{}{}{}", kIncomplete, getpid(),
                                            attempt == 1 ? "" : fmt::format(".{}", attempt));
    std::error_code error;
    if (fs::create_directory(staging, error)) return staging;
    if (error) fail({folder.string(), 0}, fmt::format("can't be written to: {}", error.message()));
  }
  fail({folder.string(), 0}, "is full of folders incomplete-…");
}

}  // namespace

GrowingFile::GrowingFile(const fs::path& path, fs::path named)
    : named_(std::move(named)),
      file_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (file_ < 0)
    fail({named_.string(), 0}, fmt::format("can't be written: {}", std::strerror(errno)));
  // Shows others that it is still being written.
  (void)::flock(file_, LOCK_SH | LOCK_NB);
}

GrowingFile::~GrowingFile() {
  try {
    flush();
  } catch (const std::exception&) {  // Already reported by sync() or commit().
    text_.clear();
  }
  ::close(file_);
}

void GrowingFile::flush() {
  std::string_view rest = text_;
  while (!rest.empty()) {
    const ssize_t written = ::write(file_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      text_.clear();
      fail({named_.string(), 0}, fmt::format("can't be written: {}", std::strerror(errno)));
    }
    has_written_ = true;
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  text_.clear();
}

void GrowingFile::finish() {
  flush();
  // Pipes and some file systems don't support it (EINVAL), and need not.
  if (::fsync(file_) != 0 && (errno == EIO || errno == ENOSPC || errno == EDQUOT)) {
    fail({named_.string(), 0}, fmt::format("can't be written: {}", std::strerror(errno)));
  }
}

OwnFiles own_files(const fs::path& folder) { return read_own_list(folder / kOwnList); }

void finish_commit(const fs::path& folder) {
  if (folder.empty()) return finish_commit(".");
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(folder / kCommitting, error))) return;
  const FolderLock lock(folder);
  roll_forward(folder);
}

StagedFolder::StagedFolder(const fs::path& folder) : folder_(folder) {
  if (folder_ == "-") throw Error("'-' is not a folder for results: they are several files");
  make_folder(folder_);
  finish_commit(folder_);
  const FolderLock lock(folder_);
  files_internal::remove_swap_leftovers(folder_);
  own_ = own_files(folder_);
  staging_ = make_staging(folder_);
  lock_ = locked(staging_, LOCK_EX | LOCK_NB);
  try {
    write_through(staging_ / kOwnList, kOwnListHeader, folder_ / kOwnList);
  } catch (...) {
    delete_own_folder(staging_);
    throw;
  }
}

StagedFolder::~StagedFolder() {
  const bool has_grown = std::any_of(growing_.begin(), growing_.end(),
                                     [](const auto& file) { return file->has_written(); });
  try {
    // A grown file is kept after an interruption; the folder's name marks it as incomplete.
    if (!has_grown) delete_own_folder(staging_);
  } catch (const std::exception&) {  // Out of memory; the next result here removes it.
    static_cast<void>(has_grown);
  }
  if (lock_ >= 0) ::close(lock_);
}

void StagedFolder::require_free(const fs::path& name) const {
  if (!is_within(name))
    throw Error(fmt::format("'{}' is not a path below a folder", name.string()));
  require_way(folder_, name);
  std::error_code error;
  const fs::file_status status = fs::symlink_status(folder_ / name, error);
  if (!fs::exists(status)) return;
  if (fs::is_directory(status)) {
    fail({(folder_ / name).string(), 0}, "is a folder, expected a file");
  }
  if (own_.count(name) > 0) return;
  fail(
      {(folder_ / name).string(), 0},
      fmt::format("was not written by Tagfield ({} does not list it), and is not replaced: move it "
                  "away, or choose another folder",
                  (folder_ / kOwnList).string()));
}

std::shared_ptr<GrowingFile> StagedFolder::grow(const fs::path& name) {
  require_free(name);
  const fs::path place = staging_ / name;
  make_folder(place.parent_path());
  growing_.push_back(std::make_shared<GrowingFile>(place, folder_ / name));
  added_.insert(name);
  return growing_.back();
}

void StagedFolder::add(const fs::path& name, const std::string& text) {
  require_free(name);
  const fs::path place = staging_ / name;
  make_folder(place.parent_path());
  write_through(place, text, folder_ / name);
  added_.insert(name);
}

void StagedFolder::add_written(const fs::path& name,
                               const std::function<void(GrowingFile&)>& write) {
  require_free(name);
  const fs::path place = staging_ / name;
  make_folder(place.parent_path());
  GrowingFile file(place, folder_ / name);
  write(file);
  file.finish();
  added_.insert(name);
}

void StagedFolder::add_copy(const fs::path& name, const fs::path& from) {
  add_written(name, [&from](GrowingFile& file) {
    read_in_blocks(from.string(), [&file](std::string_view block) {
      file.text().append(block);
      file.sync();
    });
  });
}

void StagedFolder::keep(const fs::path& name) { kept_.insert(name); }

const fs::path& StagedFolder::staging() const {
  for (const auto& file : growing_) file->flush();
  return staging_;
}

void StagedFolder::commit(const std::vector<fs::path>& stale) {
  for (const auto& file : growing_) file->finish();
  const FolderLock lock(folder_);
  roll_forward(folder_);  // The commit of another program that was killed meanwhile.
  remove_abandoned(folder_);
  own_ = own_files(folder_);
  for (const fs::path& name : added_) require_free(name);
  OwnFiles kept;
  std::copy_if(own_.begin(), own_.end(), std::inserter(kept, kept.end()), [&](const auto& name) {
    return added_.count(name) == 0 &&
           std::none_of(stale.begin(), stale.end(),
                        [&](const fs::path& place) { return is_at_or_below(name, place); });
  });
  OwnFiles after = added_;
  after.insert(kept.begin(), kept.end());
  write_through(staging_ / kOwnList, own_list_of(after), folder_ / kOwnList);
  growing_.clear();
  own_.insert(kept_.begin(), kept_.end());  // So that they may stay.
  kept.insert(kept_.begin(), kept_.end());
  if (!files_internal::swap_in(folder_, staging_, own_, kept)) move_in(folder_, staging_);
  added_.clear();
  if (lock_ >= 0) ::close(std::exchange(lock_, -1));  // It would now be a lock on `folder_`.
}

}  // namespace tagfield
