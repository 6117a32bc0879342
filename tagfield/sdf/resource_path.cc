// SPDX-License-Identifier: Apache-2.0
#include "tagfield/sdf/resource_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>

#include "tagfield/base/file_kind.h"
#include "tagfield/base/number.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBlankInUri = "%20";

void add_folder(std::vector<std::string>& folders, const fs::path& folder) {
  if (!folder.empty() && is_folder(folder)) {
    folders.push_back(fs::absolute(folder).lexically_normal().string());
  }
}

void add_environment(std::vector<std::string>& folders, const char* variable) {
  const char* value = std::getenv(variable);
  if (value == nullptr) return;
  std::istringstream list(value);
  for (std::string folder; std::getline(list, folder, ':');) add_folder(folders, folder);
}

/// Where Gazebo 11 looks for relative paths in one of its resource folders.
void add_resource_folder(std::vector<std::string>& roots, const fs::path& folder) {
  for (const char* inside : {"", "models", "media/models", "Media/models"}) {
    add_folder(roots, folder / inside);
  }
}

void add_home(std::vector<std::string>& folders, const char* folder) {
  const char* home = std::getenv("HOME");
  if (home != nullptr && *home != '\0') add_folder(folders, fs::path(home) / folder);
}

std::string in_small_letters(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// The entry of `folder` whose name equals `name` ignoring case, the first in order; nullopt if
/// there is none.
std::optional<fs::path> entry_like(const fs::path& folder, const std::string& name) {
  std::vector<fs::path> alike;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (in_small_letters(entry->path().filename().string()) == in_small_letters(name)) {
      alike.push_back(entry->path());
    }
  }
  if (alike.empty()) return std::nullopt;
  return *std::min_element(alike.begin(), alike.end());
}

/// folder/rest, ignoring the case of its parts; "" if it doesn't exist.
std::string find_like(const fs::path& folder, const fs::path& rest) {
  fs::path path = folder;
  for (const fs::path& part : rest) {
    if (part.empty() || part == ".") continue;
    if (is_there(path / part)) {
      path /= part;
      continue;
    }
    const auto alike = entry_like(path, part.string());
    if (!alike) return "";
    path = *alike;
  }
  return path == folder ? "" : path.string();
}

/// folder/rest in the first folder that has it; case is ignored only if no folder has it as
/// written.
FoundResource find_below(const std::vector<std::string>& folders, const fs::path& rest) {
  if (rest.empty() || rest.is_absolute()) return {};
  for (const std::string& folder : folders) {
    const fs::path path = fs::path(folder) / rest;
    if (is_there(path)) return {path.string()};
  }
  for (const std::string& folder : folders) {
    const std::string path = find_like(folder, rest);
    if (!path.empty()) return {path, "found with a different case, as '" + path + "'"};
  }
  return {};
}

/// For "models/REST" in folders that are called "models" themselves: REST below the first that has
/// it, as if the folder above them were searched.
FoundResource find_below_namesake(const std::vector<std::string>& folders, const fs::path& path) {
  const fs::path first = *path.begin();
  std::vector<std::string> namesakes;
  std::copy_if(folders.begin(), folders.end(), std::back_inserter(namesakes),
               [&](const std::string& folder) { return fs::path(folder).filename() == first; });
  return find_below(namesakes, path.lexically_relative(first));
}

FoundResource find_path(const std::string& path, const std::string& naming_file,
                        const ResourcePaths& paths) {
  if (path.empty()) return {};
  if (fs::path(path).is_absolute()) {
    return is_there(path) ? FoundResource{path} : FoundResource{};
  }
  std::vector<std::string> folders = {fs::path(naming_file).parent_path().string()};
  folders.insert(folders.end(), paths.folders.begin(), paths.folders.end());
  folders.insert(folders.end(), paths.roots.begin(), paths.roots.end());
  FoundResource found = find_below(folders, path);
  return found.path.empty() ? find_below_namesake(folders, path) : found;
}

std::string without_leading_slashes(const std::string& path) {
  return path.substr(std::min(path.find_first_not_of('/'), path.size()));
}

std::string with_blanks(const std::string& uri) {
  std::string text;
  std::size_t begin = 0;
  for (std::size_t at = uri.find(kBlankInUri); at != std::string::npos;
       at = uri.find(kBlankInUri, begin)) {
    text += uri.substr(begin, at - begin) + ' ';
    begin = at + kBlankInUri.size();
  }
  return text + uri.substr(begin);
}

/// Parts of https://HOST/1.0/OWNER/models/NAME[/VERSION[/files/REST]].
struct FuelName {
  std::string host;
  std::string owner;
  std::string model;
  std::string version;  ///< "" for the newest version.
  fs::path rest;
};

std::optional<FuelName> fuel_name(const std::string& rest) {
  std::vector<std::string> parts;
  std::istringstream text(with_blanks(rest));
  for (std::string part; std::getline(text, part, '/');) parts.push_back(part);
  const auto is_up = [](const std::string& part) { return part == ".." || part == "."; };
  if (parts.size() < 5 || parts[3] != "models" || std::any_of(parts.begin(), parts.end(), is_up)) {
    return std::nullopt;
  }
  FuelName name{parts[0], parts[2], parts[4], "", {}};
  if (parts.size() > 5 && parts[5] != "tip") name.version = parts[5];
  for (std::size_t i = 7; i < parts.size(); ++i) name.rest /= parts[i];
  return name;
}

/// The subfolder of `model` with the highest number as its name; "" if there is none.
std::string newest_version(const fs::path& model) {
  double newest = -1.0;
  std::string found;
  std::error_code error;
  for (fs::directory_iterator entry(model, error), end; !error && entry != end;
       entry.increment(error)) {
    const auto version = parse_number(entry->path().filename().string());
    if (!version || *version <= newest || !is_folder(entry->path())) continue;
    newest = *version;
    found = entry->path().string();
  }
  return found;
}

/// Without a trailing '/' if `rest` is empty.
fs::path below_folder(const fs::path& folder, const fs::path& rest) {
  return rest.empty() ? folder : folder / rest;
}

FoundResource find_in_fuel(const FuelName& name, const ResourcePaths& paths) {
  const fs::path below =
      fs::path(name.host) / in_small_letters(name.owner) / "models" / in_small_letters(name.model);
  for (const std::string& cache : paths.fuel) {
    const fs::path model = fs::path(cache) / below;
    const std::string version =
        name.version.empty() ? newest_version(model) : (model / name.version).string();
    if (!version.empty() && is_there(below_folder(version, name.rest))) {
      return {below_folder(version, name.rest).string()};
    }
  }
  for (const std::string& called : {name.model, model_name(name.model)}) {
    FoundResource found = find_below(paths.folders, below_folder(called, name.rest));
    if (found.path.empty()) continue;
    found.oddity = "not in Fuel's caches; '" + found.path + "' is used instead";
    return found;
  }
  return {};
}

bool is_within(const fs::path& path, const std::string& folder) {
  std::error_code error;
  const fs::path around = fs::weakly_canonical(folder, error);
  const auto [rest, end] = std::mismatch(around.begin(), around.end(), path.begin(), path.end());
  return rest == around.end() || (rest->empty() && std::next(rest) == around.end());
}

/// Whether a file is in a folder allowed for a world's files, after resolving links.
bool is_allowed(const std::string& found, const std::string& naming_file,
                const ResourcePaths& paths) {
  if (paths.allow_outside) return true;
  std::error_code error;
  const fs::path path = fs::weakly_canonical(found, error);
  std::vector<std::string> allowed = {fs::path(naming_file).parent_path().string()};
  for (const auto* folders : {&paths.folders, &paths.roots, &paths.fuel}) {
    allowed.insert(allowed.end(), folders->begin(), folders->end());
  }
  return std::any_of(allowed.begin(), allowed.end(),
                     [&](const std::string& folder) { return is_within(path, folder); });
}

FoundResource find_anywhere(const std::string& uri, const std::string& naming_file,
                            const ResourcePaths& paths) {
  const std::size_t scheme_end = uri.find("://");
  if (scheme_end == std::string::npos) return find_path(uri, naming_file, paths);
  const std::string scheme = uri.substr(0, scheme_end);
  const std::string rest = uri.substr(scheme_end + 3);
  if (scheme == "model" || scheme == "package") {
    return find_below(paths.folders, without_leading_slashes(rest));
  }
  if (scheme == "file") return find_path(rest, naming_file, paths);
  if (scheme == "https" || scheme == "http") {
    const auto name = fuel_name(rest);
    return name ? find_in_fuel(*name, paths) : FoundResource{};
  }
  return {};
}

}  // namespace

ResourcePaths resource_paths(const std::string& world_path,
                             const std::vector<std::string>& search_paths) {
  ResourcePaths paths;
  for (const std::string& folder : search_paths) add_folder(paths.folders, folder);
  const fs::path world_folder = fs::absolute(world_path).lexically_normal().parent_path();
  add_folder(paths.folders, world_folder);
  add_folder(paths.folders, world_folder / "models");
  add_folder(paths.folders, world_folder.parent_path() / "models");
  for (const char* variable :
       {"SDF_PATH", "GAZEBO_MODEL_PATH", "IGN_GAZEBO_RESOURCE_PATH", "GZ_SIM_RESOURCE_PATH"}) {
    add_environment(paths.folders, variable);
  }
  add_home(paths.folders, ".gazebo/models");
  add_folder(paths.folders, "/usr/share/gazebo-11/models");
  if (world_folder.filename() == "worlds") add_folder(paths.roots, world_folder.parent_path());
  std::vector<std::string> resources;
  add_environment(resources, "GAZEBO_RESOURCE_PATH");
  add_folder(resources, "/usr/share/gazebo-11");
  for (const std::string& folder : resources) add_resource_folder(paths.roots, folder);
  for (const char* variable : {"GZ_FUEL_CACHE_PATH", "IGN_FUEL_CACHE_PATH"}) {
    add_environment(paths.fuel, variable);
  }
  for (const char* folder : {".gz/fuel", ".ignition/fuel"}) add_home(paths.fuel, folder);
  return paths;
}

FoundResource find_resource(const std::string& uri, const std::string& naming_file,
                            const ResourcePaths& paths) {
  FoundResource found = find_anywhere(uri, naming_file, paths);
  if (found.path.empty() || is_allowed(found.path, naming_file, paths)) return found;
  return {"",
          "'" + found.path + "' lies outside of all folders of models (--allow-outside reads it)"};
}

std::string model_name(const std::string& uri) {
  std::string path = with_blanks(uri);
  path.resize(path.find_last_not_of('/') + 1);
  std::string name = in_small_letters(path.substr(path.find_last_of('/') + 1));
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

std::string looked_in(const ResourcePaths& paths) {
  std::string folders;
  for (const std::string& folder : paths.folders) {
    folders += (folders.empty() ? "" : ", ") + folder;
  }
  return "looked in " + (folders.empty() ? "no folder" : folders);
}

std::string not_found(const std::string& uri, const ResourcePaths& paths) {
  return "can't find '" + uri + "' (" + looked_in(paths) + ")";
}

}  // namespace tagfield
