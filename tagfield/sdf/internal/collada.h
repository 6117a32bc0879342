// SPDX-License-Identifier: Apache-2.0
/// @file
/// Collada files, reduced to their geometry.
#pragma once

#include <string>

namespace tagfield {

/// Whether a file's name has the extension of Collada.
bool is_collada(const std::string& path);

/// The Collada file at `path` without appearance, lights, cameras and animations: irregularities in
/// them keep assimp from reading the geometry, which Gazebo reads nevertheless. Names of materials
/// are kept. Throws Error if the file is not Collada, or if a list of indices contains anything but
/// integers.
std::string collada_geometry(const std::string& path);

}  // namespace tagfield
