// SPDX-License-Identifier: Apache-2.0
/// @file
/// Meshes from Gazebo's loaders as Tagfield's.
#pragma once

#include <cstdint>
#include <functional>

#include "tagfield/world/scene.h"

namespace tagfield {

/// A part of a mesh, from any version of Gazebo.
struct MeshPart {
  std::uint32_t vertices = 0;
  std::uint32_t indices = 0;  ///< Three per triangle.
  std::function<Eigen::Vector3d(std::uint32_t)> vertex;
  std::function<std::uint32_t(std::uint32_t)> index;
};

/// Appends a scaled part. A mirroring scale turns faces inside out, so the order of vertices is
/// then reversed.
void append(const MeshPart& part, const Eigen::Vector3d& scale, TriangleMesh& mesh);

/// Moves the centre of the mesh's bounding box to the origin.
void move_to_centre(TriangleMesh& mesh);

}  // namespace tagfield
