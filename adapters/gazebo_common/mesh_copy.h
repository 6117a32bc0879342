// SPDX-License-Identifier: Apache-2.0
/// @file
/// Meshes of Gazebo's loaders as Tagfield's.
#pragma once

#include <cstdint>
#include <functional>

#include "tagfield/world/scene.h"

namespace tagfield {

/// A part of a mesh, whichever Gazebo has loaded it.
struct MeshPart {
  std::uint32_t vertices = 0;
  std::uint32_t indices = 0;  ///< Three a triangle.
  std::function<Eigen::Vector3d(std::uint32_t)> vertex;
  std::function<std::uint32_t(std::uint32_t)> index;
};

/// A mirroring scale turns faces inside out, so it takes the other order of corners.
void append(const MeshPart& part, const Eigen::Vector3d& scale, TriangleMesh& mesh);

/// So that the middle of its bounding box is the origin.
void move_to_centre(TriangleMesh& mesh);

}  // namespace tagfield
