// SPDX-License-Identifier: Apache-2.0
/// @file
/// The volume of meshes, independent of how they were made.
#pragma once

#include <Eigen/Geometry>

#include "tagfield/world/scene.h"

namespace tagfield {

/// By the divergence theorem, the sum over the tetrahedra from the origin to each triangle:
/// positive only if faces point outward.
inline double volume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sum += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c])) / 6.0;
  }
  return sum;
}

}  // namespace tagfield
