// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <set>

#include "adapters/archive/unpacked_archive.h"
#include "tagfield/base/error.h"
#include "tagfield/base/file_kind.h"

namespace tagfield {
namespace fs = std::filesystem;
namespace {

bool ends_with(const std::string& text, const std::string& ending) {
  return text.size() > ending.size() &&
         text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

}  // namespace

bool is_archive(const std::string& path) {
  constexpr const char* kEndings[] = {".tar", ".tar.zst", ".tar.gz", ".tar.xz",
                                      ".tgz", ".csv.zst", ".csv.gz", ".csv.xz"};
  return std::any_of(std::begin(kEndings), std::end(kEndings), [&](const char* ending) {
    return ends_with(path, ending) && !is_folder(path);
  });
}

fs::path UnpackedArchive::tables() const {
  std::set<fs::path> folders;
  std::set<fs::path> tables;
  for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
    if (!entry.is_regular_file()) continue;
    tables.insert(entry.path());
    folders.insert(entry.path().parent_path());
  }
  if (folders.empty()) fail({path_, 0}, "holds no tables (*.csv)");
  if (folders.size() > 1) {
    fail({path_, 0}, "holds tables in several folders, expected those of one recording");
  }
  return tables.size() == 1 ? *tables.begin() : *folders.begin();
}

}  // namespace tagfield
