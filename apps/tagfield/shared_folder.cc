// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/shared_folder.h"

namespace tagfield {

namespace fs = std::filesystem;

fs::path shared_folder(const std::string& name) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed = program.parent_path().parent_path() / "share/tagfield" / name;
  return fs::is_directory(installed, error) ? installed : fs::path(TAGFIELD_SOURCES) / name;
}

}  // namespace tagfield
