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

/// A mesh as stored in a file.
struct MeshFile {
  TriangleMesh mesh;                   ///< [m], each coordinate multiplied by the requested scale.
  std::vector<std::string> materials;  ///< Names of the file's materials that the mesh uses.
};

/// Reads Collada, STL, OBJ and every other format of Assimp, in a separate process, with limits on
/// time and memory that depend on the file's size, because some malformed files crash Assimp.
class MeshReader {
 public:
  MeshReader();

  /// Collada's unit of length is applied but its up axis is not, as in Gazebo, so a mesh has the
  /// same orientation as there. `submesh` selects one named part ("" for all), `center` moves that
  /// part's bounding box to the origin. Throws Error "FILE: …" if the file is missing, can't be
  /// read, has no triangles, or has coordinates that are not finite.
  MeshFile read(const std::string& path, const Eigen::Vector3d& scale = Eigen::Vector3d::Ones(),
                const std::string& submesh = "", bool center = false);

 private:
  WorkerProcess process_;
};

}  // namespace tagfield
