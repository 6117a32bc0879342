// SPDX-License-Identifier: Apache-2.0
/// @file
/// Resolution of the URIs in a world file to local files.
#pragma once

#include <string>
#include <vector>

namespace tagfield {

/// The folders that are searched for files, in search order.
struct ResourcePaths {
  std::vector<std::string> folders;  ///< Folders that contain models.
  std::vector<std::string> roots{};  ///< For relative paths only.
  std::vector<std::string> fuel{};   ///< Caches of Gazebo Fuel: HOST/OWNER/models/NAME/VERSION.
  bool allow_outside = false;        ///< Allows files in other folders, too.
};

/// `search_paths`; the world file's folder, its `models` folder and the `models` folder beside it;
/// the folders in the environment variables SDF_PATH, GAZEBO_MODEL_PATH, IGN_GAZEBO_RESOURCE_PATH
/// and GZ_SIM_RESOURCE_PATH (separated by ':'); the models that Gazebo has downloaded
/// (~/.gazebo/models) and those shipped with Gazebo 11. Folders that don't exist are left out.
/// Relative paths are also searched for in the parent of a folder called `worlds`, and as Gazebo 11
/// does in the folders of GAZEBO_RESOURCE_PATH. Fuel's caches are GZ_FUEL_CACHE_PATH,
/// IGN_FUEL_CACHE_PATH, ~/.gz/fuel and ~/.ignition/fuel.
ResourcePaths resource_paths(const std::string& world_path,
                             const std::vector<std::string>& search_paths);

/// A file or folder; the path is empty if nothing was found.
struct FoundResource {
  std::string path;
  std::string oddity{};  ///< How it differs from the URI, or why it is unused; or "".
};

/// The file or folder that `uri` names:
/// - `model://NAME/rest` and `package://NAME/rest`: NAME/rest in the first folder that has it,
/// - absolute paths, `file://` or not: that path,
/// - relative paths, `file://` or not: beside `naming_file` (the file that contains the URI), then
///   in the folders; NAME/rest is also rest in a folder called NAME,
/// - `https://FUEL/1.0/OWNER/models/NAME`: in Fuel's caches, else as model://NAME.
/// If nothing exists under that name, it is searched for ignoring case (an oddity). A URI with any
/// other scheme is never found.
FoundResource find_resource(const std::string& uri, const std::string& naming_file,
                            const ResourcePaths& paths);

/// The last part of a URI's path in the form of a model's name: in lower case, with '_' for spaces.
std::string model_name(const std::string& uri);

/// "looked in A, B", for an error message.
std::string looked_in(const ResourcePaths& paths);

/// "can't find 'URI' (looked in A, B)".
std::string not_found(const std::string& uri, const ResourcePaths& paths);

}  // namespace tagfield
