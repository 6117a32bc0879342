#include "tagfield/sdf/resource_path.h"

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <system_error>

namespace tagfield {
namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

void add_folder(ResourcePaths& paths, const fs::path& folder) {
  std::error_code error;
  if (!folder.empty() && fs::is_directory(folder, error)) {
    paths.folders.push_back(fs::absolute(folder).lexically_normal().string());
  }
}

void add_environment(ResourcePaths& paths, const char* variable) {
  const char* value = std::getenv(variable);
  if (value == nullptr) return;
  std::istringstream list(value);
  for (std::string folder; std::getline(list, folder, ':');) add_folder(paths, folder);
}

std::string find_in_folders(const std::string& name, const ResourcePaths& paths) {
  if (name.empty() || fs::path(name).is_absolute()) return "";
  for (const std::string& folder : paths.folders) {
    const fs::path path = fs::path(folder) / name;
    if (is_there(path)) return path.string();
  }
  return "";
}

std::string find_path(const std::string& path, const std::string& naming_file,
                      const ResourcePaths& paths) {
  if (path.empty()) return "";
  // An absolute path stays as it is here: fs::path's `/` takes the right side then.
  const fs::path beside = fs::path(naming_file).parent_path() / path;
  if (is_there(beside)) return beside.string();
  return find_in_folders(path, paths);
}

}  // namespace

ResourcePaths resource_paths(const std::string& world_path,
                             const std::vector<std::string>& search_paths) {
  ResourcePaths paths;
  for (const std::string& folder : search_paths) add_folder(paths, folder);
  const fs::path world_folder = fs::absolute(world_path).parent_path();
  add_folder(paths, world_folder);
  add_folder(paths, world_folder / "models");
  add_folder(paths, world_folder.parent_path() / "models");
  for (const char* variable :
       {"SDF_PATH", "GAZEBO_MODEL_PATH", "IGN_GAZEBO_RESOURCE_PATH", "GZ_SIM_RESOURCE_PATH"}) {
    add_environment(paths, variable);
  }
  return paths;
}

std::string find_resource(const std::string& uri, const std::string& naming_file,
                          const ResourcePaths& paths) {
  const std::size_t scheme_end = uri.find("://");
  if (scheme_end == std::string::npos) return find_path(uri, naming_file, paths);
  const std::string scheme = uri.substr(0, scheme_end);
  const std::string rest = uri.substr(scheme_end + 3);
  if (scheme == "model" || scheme == "package") return find_in_folders(rest, paths);
  if (scheme == "file") return find_path(rest, naming_file, paths);
  return "";
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
