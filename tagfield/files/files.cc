#include "tagfield/files/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "tagfield/base/error.h"
#include "tagfield/files/internal/file_steps.h"
#include "tagfield/files/staged_folder.h"

namespace tagfield {
namespace fs = std::filesystem;
namespace {

/// An open file, closed at the end.
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

/// Gives the size that it says it has; that of a pipe is 0.
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

/// All that follows, to its end.
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

/// Whether `path` is there and neither a file nor a folder, such as /dev/stdout.
bool is_special(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

/// Where a file is to be replaced: what a symbolic link points to.
fs::path target_of(const std::string& path) {
  std::error_code error;
  const fs::path target = fs::is_symlink(path, error) ? fs::canonical(path, error) : fs::path(path);
  return error ? fs::path(path) : target;
}

fs::path beside(const fs::path& target) {
  return fmt::format("{}.{}.partial", target.string(), getpid());
}

}  // namespace

std::string read_text_file(const std::string& path, std::size_t most_bytes) {
  const Opened file = opened(path);
  std::string text;
  text.reserve(std::min(require_file(file.get(), path), most_bytes));
  read_all(file.get(), path, [&](std::string_view bytes) {
    text += bytes;
    if (text.size() > most_bytes) {
      fail({path, 0}, fmt::format("is longer than {} bytes", most_bytes));
    }
  });
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
  std::vector<std::pair<fs::path, fs::path>> renames;
  try {
    for (const auto& [path, text] : files) {
      if (is_special(path)) {
        files_internal::write_through(path, text, path);
        continue;
      }
      const fs::path target = target_of(path);
      renames.emplace_back(beside(target), target);
      files_internal::write_through(renames.back().first, text, path);
    }
    for (const auto& [from, to] : renames) files_internal::rename_over(from, to);
  } catch (const Error&) {
    std::error_code ignored;
    for (const auto& [from, to] : renames) fs::remove(from, ignored);
    throw;
  }
}

}  // namespace tagfield
