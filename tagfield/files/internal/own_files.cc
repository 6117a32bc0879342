// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/internal/own_files.h"

#include <algorithm>
#include <sstream>
#include <system_error>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/files/files.h"

namespace tagfield::files_internal {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMaxListBytes = 10'000'000;

}  // namespace

bool is_within(const fs::path& name) {
  return !name.empty() && name.is_relative() && name.native() == name.lexically_normal().native() &&
         *name.begin() != ".." && *name.begin() != "." && name.has_filename();
}

std::string own_list_of(const OwnFiles& files) {
  std::string text = kOwnListHeader;
  for (const fs::path& file : files) text += file.generic_string() + "\n";
  return text;
}

OwnFiles read_own_list(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(path, error))) return {};
  std::istringstream text(read_text_file(path.string(), kMaxListBytes));
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

OwnFiles files_below(const fs::path& folder) {
  OwnFiles files;
  std::error_code error;
  fs::recursive_directory_iterator entry(folder, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    if (entry->symlink_status().type() != fs::file_type::directory) {
      files.insert(entry->path().lexically_relative(folder));
    }
  }
  if (error) fail({folder.string(), 0}, "can't be listed: " + error.message());
  return files;
}

bool is_own_folder(const fs::path& folder) {
  std::error_code error;
  return fs::exists(fs::symlink_status(folder / kOwnList, error)) || fs::is_empty(folder, error);
}

void delete_own_folder(const fs::path& folder) {
  std::vector<fs::path> inside;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    if (entry->path().filename() != kOwnList) inside.push_back(entry->path());
  }
  // Without its list, its ownership would be lost.
  if (error) return;
  for (const fs::path& path : inside) {
    fs::remove_all(path, error);
    if (error) return;
  }
  fs::remove(folder / kOwnList, error);
  fs::remove(folder, error);
}

bool is_at_or_below(const fs::path& name, const fs::path& place) {
  const auto [in_name, in_place] =
      std::mismatch(name.begin(), name.end(), place.begin(), place.end());
  return in_place == place.end();
}

}  // namespace tagfield::files_internal
