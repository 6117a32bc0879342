// SPDX-License-Identifier: Apache-2.0
/// @file
/// Loading of an SDF world file into a Scene.
#pragma once

#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/world/scene.h"

namespace tagfield {

/// What may be missing from a world, and where its files may be.
struct WorldOptions {
  bool skip_missing = false;   ///< Only warns of missing or broken files.
  bool allow_outside = false;  ///< Also reads files outside all search folders.
};

/// Reads a `.sdf` or `.world` file of SDF 1.2 or later: nested models, includes (merged ones, too),
/// poses relative to frames, a saved `<state>`, collisions of all shapes, names of materials, and
/// sensors of type `rfid` (antennas) and `rfidtag` (tags) with the parameters of their `<plugin>`.
/// A file with one model is a world containing only that model.
///
/// Files are searched for as described in resource_path.h, first in `search_paths`.
///
/// Errors that Gazebo 11 tolerates become warnings. Throws Error "FILE:LINE: …" for a file that is
/// missing or malformed or contains no world, for invalid numbers, and, unless they are to be
/// skipped, for the models and meshes that can't be found (all in one message) or read.
Scene load_world(const std::string& path, const std::vector<std::string>& search_paths,
                 Diagnostics& diagnostics, const WorldOptions& options = {});

}  // namespace tagfield
