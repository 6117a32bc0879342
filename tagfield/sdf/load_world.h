/// @file
/// An SDF world file to a Scene. The only room that includes sdformat.
#pragma once

#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/world/scene.h"

namespace tagfield {

/// Reads a `.sdf` or `.world` file: nested models, includes, poses relative to frames, boxes,
/// cylinders, spheres, planes and meshes as collisions, names of materials, and sensors of type
/// `rfid` (antennas) and `rfidtag` (tags) with the parameters of their `<plugin>`.
///
/// `model://NAME` and relative URIs are looked up in this order: `search_paths`; the world's
/// folder, its `models` folder and the `models` folder beside it; the folders in the environment's
/// SDF_PATH, GAZEBO_MODEL_PATH, IGN_GAZEBO_RESOURCE_PATH and GZ_SIM_RESOURCE_PATH. A relative URI
/// is tried beside the file that names it first. `file://` URIs and absolute paths are taken.
///
/// What is odd but leaves the geometry whole becomes a warning. Throws Error "FILE:LINE: …" for a
/// file that is missing or malformed, holds no world, includes a model that can't be found, or
/// names a mesh that is missing or broken.
Scene load_world(const std::string& path, const std::vector<std::string>& search_paths,
                 Diagnostics& diagnostics);

}  // namespace tagfield
