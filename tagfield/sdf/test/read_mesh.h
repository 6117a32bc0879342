// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reading of single meshes.
#pragma once

#include <string>

#include "tagfield/sdf/internal/mesh_file.h"

namespace tagfield {

/// With a reader of its own.
inline MeshFile read_mesh(const std::string& path,
                          const Eigen::Vector3d& scale = Eigen::Vector3d::Ones(),
                          const std::string& submesh = "", bool center = false) {
  MeshReader reader;
  return reader.read(path, scale, submesh, center);
}

}  // namespace tagfield
