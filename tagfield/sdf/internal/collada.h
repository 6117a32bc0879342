// SPDX-License-Identifier: Apache-2.0
/// @file
/// Collada files, without what is not geometry.
#pragma once

#include <string>

namespace tagfield {

/// Whether a file is Collada by its name.
bool is_collada(const std::string& path);

/// The Collada file at `path` without its looks, lights, cameras and movements: what is odd in them
/// keeps assimp from reading the geometry, which Gazebo reads all the same. Names of materials
/// stay.
/// Throws Error where the file is no Collada, or a list of indices holds anything but whole
/// numbers.
std::string collada_geometry(const std::string& path);

}  // namespace tagfield
