// SPDX-License-Identifier: Apache-2.0
/// @file
/// An SDF world file to a Scene.
#pragma once

#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/world/scene.h"

namespace tagfield {

/// What a world may leave open and where its files may be.
struct WorldOptions {
  bool skip_missing = false;  ///< Goes on, with warnings, without files that are missing or broken.
  bool allow_outside = false;  ///< Reads files outside of all folders that are searched, too.
};

/// Reads a `.sdf` or `.world` file of SDF 1.2 or later: models in models, includes (merged ones
/// too), poses relative to frames, a saved `<state>`, collisions of all shapes, names of materials,
/// and sensors of type `rfid` (antennas) and `rfidtag` (tags) with the parameters of their
/// `<plugin>`. A file of one model is a world of it alone.
///
/// Files are looked up as resource_path.h says, in `search_paths` first.
///
/// What Gazebo 11 makes do with becomes a warning. Throws Error "FILE:LINE: …" for a file that is
/// missing or malformed or holds no world, for numbers that are none, and, unless they are to be
/// skipped, for the models and meshes that can't be found (all in one message) or read.
Scene load_world(const std::string& path, const std::vector<std::string>& search_paths,
                 Diagnostics& diagnostics, const WorldOptions& options = {});

}  // namespace tagfield
