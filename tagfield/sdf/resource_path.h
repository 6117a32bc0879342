/// @file
/// Where a URI in a world file points to on this disk.
#pragma once

#include <string>
#include <vector>

namespace tagfield {

/// The folders that hold models, in the order in which they are tried.
struct ResourcePaths {
  std::vector<std::string> folders;
};

/// `search_paths`; the world file's folder, its `models` folder and the `models` folder beside it;
/// the folders in the environment's SDF_PATH, GAZEBO_MODEL_PATH, IGN_GAZEBO_RESOURCE_PATH and
/// GZ_SIM_RESOURCE_PATH (separated by ':'). Folders that don't exist are left out.
ResourcePaths resource_paths(const std::string& world_path,
                             const std::vector<std::string>& search_paths);

/// The file or folder that `uri` names, or "" if there is none:
/// - `model://NAME/rest` and `package://NAME/rest`: NAME/rest in the first folder that has it,
/// - `file://PATH` and absolute paths: that path,
/// - relative paths: beside `naming_file` (the file that holds the URI), then in the folders.
/// Any other scheme names nothing here.
std::string find_resource(const std::string& uri, const std::string& naming_file,
                          const ResourcePaths& paths);

/// "looked in A, B", for an error message.
std::string looked_in(const ResourcePaths& paths);

/// "can't find 'URI' (looked in A, B)".
std::string not_found(const std::string& uri, const ResourcePaths& paths);

}  // namespace tagfield
