// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/shared_folder.h"

#include <fmt/format.h>

#include "tagfield/base/error.h"
#include "tagfield/base/file_kind.h"

namespace tagfield {

namespace fs = std::filesystem;

fs::path shared_folder(const std::string& name) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed = program.parent_path().parent_path() / "share/tagfield" / name;
  return fs::is_directory(installed, error) ? installed : fs::path(TAGFIELD_SOURCES) / name;
}

void suggest_shared_file(const std::string& path) {
  const fs::path asked = fs::path(path).lexically_normal();
  if (is_there(path) || asked.is_absolute() || asked.empty() || *asked.begin() == "..") return;
  const fs::path shipped = shared_folder(asked.parent_path().string()) / asked.filename();
  if (asked.parent_path().empty() || !is_file(shipped)) return;
  throw Error(fmt::format("{}: no such file; the one that comes with Tagfield is {}", path,
                          shipped.string()));
}

}  // namespace tagfield
