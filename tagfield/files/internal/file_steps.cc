// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/internal/file_steps.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <system_error>

#include "tagfield/base/error.h"
#include "tagfield/base/file_kind.h"
#include "tagfield/files/staged_folder.h"

namespace tagfield::files_internal {
namespace fs = std::filesystem;

void write_through(const fs::path& path, const std::string& text, const fs::path& named) {
  GrowingFile file(path, named);
  file.text() = text;
  file.finish();
}

void rename_over(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error) fail({to.string(), 0}, fmt::format("can't be replaced: {}", error.message()));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !is_folder(folder)) {
    fail({folder.string(), 0},
         fmt::format("can't be made a folder{}", error ? ": " + error.message() : ""));
  }
}

void sync_folder(const fs::path& folder) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  ::fsync(file);
  ::close(file);
}

}  // namespace tagfield::files_internal
