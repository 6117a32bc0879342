// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where a URI in a world file points to on this disk.
#pragma once

#include <string>
#include <vector>

namespace tagfield {

/// The folders in which files are looked up, in the order in which they are tried.
struct ResourcePaths {
  std::vector<std::string> folders;  ///< That hold models.
  std::vector<std::string> roots{};  ///< For relative paths alone.
  std::vector<std::string> fuel{};   ///< Caches of Gazebo Fuel: HOST/OWNER/models/NAME/VERSION.
  bool allow_outside = false;        ///< Of all of these and of the folder of the naming file.
};

/// `search_paths`; the world file's folder, its `models` folder and the `models` folder beside it;
/// the folders in the environment's SDF_PATH, GAZEBO_MODEL_PATH, IGN_GAZEBO_RESOURCE_PATH and
/// GZ_SIM_RESOURCE_PATH (separated by ':'); what Gazebo has fetched (~/.gazebo/models) and what
/// came with Gazebo 11. Folders that don't exist are left out. Relative paths are looked up in the
/// folder above one called `worlds`, too. Fuel's caches are GZ_FUEL_CACHE_PATH,
/// IGN_FUEL_CACHE_PATH, ~/.gz/fuel and ~/.ignition/fuel.
ResourcePaths resource_paths(const std::string& world_path,
                             const std::vector<std::string>& search_paths);

/// A file or folder; no path where nothing was found.
struct FoundResource {
  std::string path;
  std::string
      oddity{};  ///< In what it is not what the URI says, or why it is not used; "" if all is well.
};

/// The file or folder that `uri` names:
/// - `model://NAME/rest` and `package://NAME/rest`: NAME/rest in the first folder that has it,
/// - `file://PATH` and absolute paths: that path,
/// - relative paths: beside `naming_file` (the file that holds the URI), then in the folders,
/// - `https://FUEL/1.0/OWNER/models/NAME`: in Fuel's caches, else as model://NAME.
/// What is not there is looked for under names in another case (an oddity). Any other scheme names
/// nothing here.
FoundResource find_resource(const std::string& uri, const std::string& naming_file,
                            const ResourcePaths& paths);

/// The last part of a URI's path as a model's name is written: in small letters, with '_' for
/// blanks.
std::string model_name(const std::string& uri);

/// "looked in A, B", for an error message.
std::string looked_in(const ResourcePaths& paths);

/// "can't find 'URI' (looked in A, B)".
std::string not_found(const std::string& uri, const ResourcePaths& paths);

}  // namespace tagfield
