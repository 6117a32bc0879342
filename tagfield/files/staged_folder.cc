#include "tagfield/files/staged_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "tagfield/base/error.h"
#include "tagfield/files/files.h"
#include "tagfield/files/internal/file_steps.h"

namespace tagfield {
namespace fs = std::filesystem;
namespace {

using files_internal::make_folder;
using files_internal::rename_over;
using files_internal::sync_folder;
using files_internal::write_through;

constexpr const char* kList = ".tagfield";
constexpr const char* kCommitting = ".tagfield-commit";
constexpr const char* kIncomplete = "incomplete-";
constexpr const char* kListHeader = "# Files that Tagfield wrote here; it replaces no others.\n";
constexpr std::size_t kMostListBytes = 10'000'000;

/// A lock on a folder, as long as it lives. -1 where it could not be had.
int locked(const fs::path& folder, int how) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return -1;
  while (::flock(file, how) != 0) {
    if (errno == EINTR) continue;
    ::close(file);
    return -1;
  }
  return file;
}

/// One program at a time moves files within a folder.
class FolderLock {
 public:
  explicit FolderLock(const fs::path& folder) : file_(locked(folder, LOCK_EX)) {}
  ~FolderLock() {
    if (file_ >= 0) ::close(file_);
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_;
};

bool is_within(const fs::path& name) {
  return !name.empty() && name.is_relative() && name.native() == name.lexically_normal().native() &&
         *name.begin() != ".." && *name.begin() != "." && name.has_filename();
}

bool is_at_or_below(const fs::path& name, const fs::path& place) {
  const auto [in_name, in_place] =
      std::mismatch(name.begin(), name.end(), place.begin(), place.end());
  return in_place == place.end();
}

std::string list_of(const OwnFiles& files) {
  std::string text = kListHeader;
  for (const fs::path& file : files) text += file.generic_string() + "\n";
  return text;
}

OwnFiles read_list(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(path, error))) return {};
  std::istringstream text(read_text_file(path.string(), kMostListBytes));
  OwnFiles files;
  int line = 0;
  for (std::string name; std::getline(text, name);) {
    ++line;
    if (name.empty() || name.front() == '#') continue;
    if (!is_within(name)) fail({path.string(), line}, "expected a file below this folder");
    files.insert(name);
  }
  return files;
}

/// Throws Error unless each part of the way to `name` is a folder or not there yet.
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

/// Files below a folder, by path in it; links are not followed.
OwnFiles files_in(const fs::path& folder) {
  OwnFiles files;
  std::error_code error;
  for (const auto& entry : fs::recursive_directory_iterator(folder, error)) {
    if (entry.symlink_status().type() != fs::file_type::directory) {
      files.insert(entry.path().lexically_relative(folder));
    }
  }
  return files;
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

/// From here on nothing can go back: all that is in `.tagfield-commit` comes to its place. May be
/// cut off anywhere and done again.
void roll_forward(const fs::path& folder) {
  const fs::path committing = folder / kCommitting;
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(committing, error))) return;
  if (fs::exists(fs::symlink_status(committing / kList, error))) {
    const OwnFiles before = read_list(folder / kList);
    const OwnFiles after = read_list(committing / kList);
    for (const fs::path& name : files_in(committing)) {
      if (name == kList) continue;
      require_way(folder, name);
      make_folder((folder / name).parent_path());
      rename_over(committing / name, folder / name);
    }
    for (const fs::path& name : before) {
      if (after.count(name) == 0) remove_with_empty_parents(folder, name);
    }
    rename_over(committing / kList, folder / kList);
    sync_folder(folder);
  }
  if (files_in(committing).empty()) fs::remove_all(committing, error);
}

/// What a run left that was killed: nobody holds the lock on it any more.
void remove_abandoned(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const fs::path& place = entry.path();
    if (place.filename().string().rfind(kIncomplete, 0) != 0) continue;
    if (!fs::is_directory(fs::symlink_status(place, error)) || !fs::exists(place / kList, error)) {
      continue;
    }
    const int lock = locked(place, LOCK_EX | LOCK_NB);
    if (lock < 0) continue;
    fs::remove_all(place, error);
    ::close(lock);
  }
}

/// Makes `incomplete-PID`, or `incomplete-PID.2` where an earlier program left one.
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
}

GrowingFile::~GrowingFile() {
  try {
    flush();
  } catch (const Error&) {  // Told where it mattered: by sync() or commit().
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
  // Pipes and some file systems can't (EINVAL), and need not.
  if (::fsync(file_) != 0 && (errno == EIO || errno == ENOSPC || errno == EDQUOT)) {
    fail({named_.string(), 0}, fmt::format("can't be written: {}", std::strerror(errno)));
  }
}

OwnFiles own_files(const fs::path& folder) { return read_list(folder / kList); }

void finish_commit(const fs::path& folder) {
  if (folder.empty()) return finish_commit(".");
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(folder / kCommitting, error))) return;
  const FolderLock lock(folder);
  roll_forward(folder);
}

StagedFolder::StagedFolder(const fs::path& folder) : folder_(folder) {
  if (folder_ == "-") throw Error("'-' is no folder for results: they are several files");
  make_folder(folder_);
  finish_commit(folder_);
  own_ = own_files(folder_);
  staging_ = make_staging(folder_);
  lock_ = locked(staging_, LOCK_EX | LOCK_NB);
  write_through(staging_ / kList, kListHeader, folder_ / kList);
}

StagedFolder::~StagedFolder() {
  const bool has_grown = std::any_of(growing_.begin(), growing_.end(),
                                     [](const auto& file) { return file->has_written(); });
  std::error_code ignored;
  // What has grown was interrupted; its name says that it is incomplete.
  if (!has_grown) fs::remove_all(staging_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

void StagedFolder::require_free(const fs::path& name) const {
  if (!is_within(name)) throw Error(fmt::format("'{}' is no path below a folder", name.string()));
  require_way(folder_, name);
  std::error_code error;
  const fs::file_status there = fs::symlink_status(folder_ / name, error);
  if (!fs::exists(there)) return;
  if (fs::is_directory(there)) fail({(folder_ / name).string(), 0}, "is a folder, expected a file");
  if (own_.count(name) > 0) return;
  fail(
      {(folder_ / name).string(), 0},
      fmt::format("was not written by Tagfield ({} does not list it), and is not replaced: move it "
                  "away, or choose another folder",
                  (folder_ / kList).string()));
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

const fs::path& StagedFolder::staging() const {
  for (const auto& file : growing_) file->flush();
  return staging_;
}

void StagedFolder::commit(const std::vector<fs::path>& stale) {
  for (const auto& file : growing_) file->finish();
  const FolderLock lock(folder_);
  roll_forward(folder_);  // Another program's that was killed meanwhile.
  own_ = own_files(folder_);
  for (const fs::path& name : added_) require_free(name);
  OwnFiles after = added_;
  std::copy_if(own_.begin(), own_.end(), std::inserter(after, after.end()), [&](const auto& name) {
    return std::none_of(stale.begin(), stale.end(),
                        [&](const fs::path& place) { return is_at_or_below(name, place); });
  });
  write_through(staging_ / kList, list_of(after), folder_ / kList);
  growing_.clear();
  rename_over(staging_, folder_ / kCommitting);
  sync_folder(folder_);
  roll_forward(folder_);
  remove_abandoned(folder_);
  added_.clear();
}

}  // namespace tagfield
