// SPDX-License-Identifier: Apache-2.0
/// @file
/// Triangle meshes from files.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "tagfield/sdf/internal/worker_process.h"
#include "tagfield/world/scene.h"

namespace tagfield {

/// A mesh as it stands in a file.
struct MeshFile {
  TriangleMesh mesh;                   ///< [m], each coordinate times the scale asked for.
  std::vector<std::string> materials;  ///< Names of the materials in the file that the mesh uses.
};

/// Reads Collada, STL, OBJ and whatever else Assimp reads, in a process of its own, with limits on
/// time and memory by the file's size: some malformed files break it.
class MeshReader {
 public:
  MeshReader();

  /// Collada's unit of length is applied and its up axis is not: Gazebo does the same, so a mesh
  /// stands as it does there. `submesh` picks one named part ("" for all), `center` moves that
  /// part's bounding box onto the origin.
  /// Throws Error "FILE: …" if the file is missing, can't be read, has no triangles, or has
  /// coordinates that are not finite.
  MeshFile read(const std::string& path, const Eigen::Vector3d& scale = Eigen::Vector3d::Ones(),
                const std::string& submesh = "", bool center = false);

 private:
  WorkerProcess process_;
};

}  // namespace tagfield
