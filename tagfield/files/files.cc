// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <memory>
#include <new>
#include <system_error>

#include "tagfield/base/error.h"
#include "tagfield/files/internal/file_steps.h"
#include "tagfield/files/staged_folder.h"

namespace tagfield {
namespace fs = std::filesystem;
namespace {

/// An open file, closed on destruction.
class Opened {
 public:
  explicit Opened(const std::string& path) : file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~Opened() {
    if (file_ >= 0) ::close(file_);
  }
  Opened(Opened&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  Opened& operator=(Opened&&) = delete;
  [[nodiscard]] int get() const { return file_; }

 private:
  int file_;
};

[[noreturn]] void fail_to_read(const std::string& path) {
  fail({path, 0}, fmt::format("can't be read: {}", std::strerror(errno)));
}

/// Returns the file's stated size; that of a pipe is 0.
std::size_t require_file(int file, const std::string& path) {
  struct stat status {};
  if (::fstat(file, &status) != 0) fail_to_read(path);
  if (S_ISDIR(status.st_mode)) fail({path, 0}, "is a folder, expected a file");
  if (S_ISCHR(status.st_mode) || S_ISBLK(status.st_mode)) {
    fail({path, 0}, "is a device, expected a file");
  }
  return static_cast<std::size_t>(status.st_size);
}

Opened opened(const std::string& path) {
  Opened file(path);
  if (file.get() < 0 && (errno == ENOENT || errno == ENOTDIR)) fail({path, 0}, "no such file");
  if (file.get() < 0) fail_to_read(path);
  return file;
}

/// Reads the rest of the file to its end.
void read_all(int file, const std::string& path,
              const std::function<void(std::string_view)>& take) {
  std::array<char, 1U << 16U> bytes;
  for (;;) {
    const ssize_t count = ::read(file, bytes.data(), bytes.size());
    if (count == 0) return;
    if (count > 0) {
      take({bytes.data(), static_cast<std::size_t>(count)});
    } else if (errno != EINTR) {
      fail_to_read(path);
    }
  }
}

/// Whether `path` exists and is neither a file nor a folder, such as /dev/stdout.
bool is_special(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

/// The file to be replaced: for a symbolic link, its target.
fs::path target_of(const std::string& path) {
  std::error_code error;
  const fs::path target = fs::is_symlink(path, error) ? fs::canonical(path, error) : fs::path(path);
  return error ? fs::path(path) : target;
}

constexpr const char* kPartial = ".partial";

fs::path beside(const fs::path& target) {
  return fmt::format("{}.{}{}", target.string(), getpid(), kPartial);
}

/// The process that created a temporary file beside `target`, by its name; 0 if it is not such a
/// file.
pid_t writer_of(const fs::path& path, const fs::path& target) {
  const std::string start = target.filename().string() + ".";
  const std::string name = path.filename().string();
  const std::size_t end = name.rfind(kPartial);
  if (name.rfind(start, 0) != 0 || end == std::string::npos || end <= start.size()) return 0;
  pid_t pid = 0;
  const char* const last = name.data() + end;
  const auto [parsed, error] = std::from_chars(name.data() + start.size(), last, pid);
  const bool is_whole = parsed == last && end + std::string_view(kPartial).size() == name.size();
  return error == std::errc{} && is_whole ? pid : 0;
}

/// Deletes temporary files of programs that were killed while writing this file: the process no
/// longer exists, and the file is not locked, as it would be by one of another machine or
/// container.
void remove_abandoned_partials(const fs::path& target) {
  std::error_code error;
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const pid_t pid = writer_of(entry.path(), target);
    if (pid <= 0 || ::kill(pid, 0) == 0 || errno != ESRCH) continue;
    const Opened file(entry.path().string());
    if (file.get() >= 0 && ::flock(file.get(), LOCK_EX | LOCK_NB) == 0) {
      fs::remove(entry.path(), error);
    }
  }
}

/// A temporary file beside its target, until it is renamed.
struct Partial {
  fs::path path;
  fs::path target;
  std::unique_ptr<GrowingFile> file;
};

Partial partial_of(const std::string& path) {
  const fs::path target = target_of(path);
  remove_abandoned_partials(target);
  Partial partial{beside(target), target, nullptr};
  partial.file = std::make_unique<GrowingFile>(partial.path, path);
  return partial;
}

}  // namespace

std::string read_text_file(const std::string& path, std::size_t max_bytes) {
  const Opened file = opened(path);
  std::string text;
  try {
    text.reserve(std::min(require_file(file.get(), path), max_bytes));
    read_all(file.get(), path, [&](std::string_view bytes) {
      text += bytes;
      if (text.size() > max_bytes) {
        fail({path, 0}, fmt::format("is longer than {} bytes", max_bytes));
      }
    });
  } catch (const std::bad_alloc&) {
    fail({path, 0}, "is longer than there is memory for");
  }
  return text;
}

void read_in_blocks(const std::string& path, const std::function<void(std::string_view)>& take) {
  const Opened file = opened(path);
  require_file(file.get(), path);
  read_all(file.get(), path, take);
}

void write_text_file(const std::string& path, const std::string& text) {
  write_text_files({{path, text}});
}

void write_text_files(const std::vector<std::pair<std::string, std::string>>& files) {
  std::vector<Partial> partials;
  try {
    for (const auto& [path, text] : files) {
      if (is_special(path)) {
        files_internal::write_through(path, text, path);
        continue;
      }
      partials.push_back(partial_of(path));
      partials.back().file->text() = text;
      partials.back().file->finish();
    }
    for (const Partial& partial : partials)
      files_internal::rename_over(partial.path, partial.target);
  } catch (const Error&) {
    std::error_code ignored;
    for (const Partial& partial : partials) fs::remove(partial.path, ignored);
    throw;
  }
}

}  // namespace tagfield
