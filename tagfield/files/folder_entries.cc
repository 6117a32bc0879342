// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/folder_entries.h"

#include <algorithm>

#include "tagfield/base/error.h"

namespace tagfield {
namespace fs = std::filesystem;

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code error;
  const fs::file_type type = fs::status(folder, error).type();
  if (type == fs::file_type::not_found) return entries;
  if (!error && type != fs::file_type::directory) return entries;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    entries.push_back(entry->path());
  }
  if (error) fail({folder.string(), 0}, "can't be listed: " + error.message());
  std::sort(entries.begin(), entries.end());
  return entries;
}

}  // namespace tagfield
