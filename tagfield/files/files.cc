#include "tagfield/files/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "tagfield/base/error.h"

namespace tagfield {
namespace fs = std::filesystem;
namespace {

void write_through(const fs::path& path, const std::string& text, const fs::path& named) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  if (!file) fail({named.string(), 0}, "can't be written (no permission, or the disk is full?)");
}

void rename_over(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error) fail({to.string(), 0}, fmt::format("can't be replaced: {}", error.message()));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder)) {
    fail({folder.string(), 0},
         fmt::format("can't be made a folder{}", error ? ": " + error.message() : ""));
  }
}

}  // namespace

std::string read_text_file(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) fail({path, 0}, "no such file");
  if (fs::is_directory(status)) fail({path, 0}, "is a folder, expected a file");
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  // An empty file sets failbit on `text`, not badbit on `file`.
  if (!file.is_open() || file.bad()) fail({path, 0}, "can't be read");
  return text.str();
}

void write_text_file(const std::string& path, const std::string& text) {
  const fs::path beside = fmt::format("{}.{}.partial", path, getpid());
  try {
    write_through(beside, text, path);
    rename_over(beside, path);
  } catch (const Error&) {
    std::error_code ignored;
    fs::remove(beside, ignored);
    throw;
  }
}

GrowingFile::GrowingFile(const fs::path& path, fs::path named)
    : named_(std::move(named)),
      file_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (file_ < 0) fail({named_.string(), 0}, "can't be written (no permission?)");
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

StagedFolder::StagedFolder(const fs::path& folder)
    : folder_(folder), staging_(folder / fmt::format("incomplete-{}", getpid())) {
  make_folder(folder_);
  std::error_code error;
  fs::create_directory(staging_, error);
  if (error) fail({folder_.string(), 0}, fmt::format("can't be written to: {}", error.message()));
}

StagedFolder::~StagedFolder() {
  const bool has_grown = std::any_of(growing_.begin(), growing_.end(),
                                     [](const auto& file) { return file->has_written(); });
  if (has_grown) return;  // Interrupted; its name says that it is incomplete.
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
}

std::shared_ptr<GrowingFile> StagedFolder::grow(const fs::path& name) {
  const fs::path place = staging_ / name;
  make_folder(place.parent_path());
  growing_.push_back(std::make_shared<GrowingFile>(place, folder_ / name));
  names_.push_back(name);
  return growing_.back();
}

void StagedFolder::add(const fs::path& name, const std::string& text) {
  const fs::path place = staging_ / name;
  make_folder(place.parent_path());
  write_through(place, text, folder_ / name);
  names_.push_back(name);
}

void StagedFolder::commit(const std::vector<fs::path>& stale) {
  for (const auto& file : growing_) file->flush();
  growing_.clear();
  for (const fs::path& name : names_) {
    make_folder((folder_ / name).parent_path());
    rename_over(staging_ / name, folder_ / name);
  }
  for (const fs::path& name : stale) remove_stale(name);
  names_.clear();
}

/// Removes what stands under `name`, except what was added there.
void StagedFolder::remove_stale(const fs::path& name) {
  const auto is_new = [&](const fs::path& file) {
    return std::find(names_.begin(), names_.end(), file.lexically_relative(folder_)) !=
           names_.end();
  };
  std::error_code ignored;
  const fs::path place = folder_ / name;
  if (!fs::is_directory(place, ignored)) {
    if (!is_new(place)) fs::remove(place, ignored);
    return;
  }
  std::vector<fs::path> old;
  for (const auto& entry : fs::recursive_directory_iterator(place, ignored)) {
    if (!entry.is_directory() && !is_new(entry.path())) old.push_back(entry.path());
  }
  for (const fs::path& file : old) fs::remove(file, ignored);
  // Removes only an empty folder.
  fs::remove(place, ignored);
}

}  // namespace tagfield
