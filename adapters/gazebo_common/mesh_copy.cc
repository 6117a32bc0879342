// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_common/mesh_copy.h"

#include <Eigen/Geometry>

namespace tagfield {

void append(const MeshPart& part, const Eigen::Vector3d& scale, TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (std::uint32_t i = 0; i < part.vertices; ++i) {
    mesh.vertices.emplace_back(part.vertex(i).cwiseProduct(scale));
  }
  const std::uint32_t second = scale.prod() < 0.0 ? 2 : 1;
  for (std::uint32_t i = 0; i + 2 < part.indices; i += 3) {
    mesh.triangles.push_back({first + part.index(i), first + part.index(i + second),
                              first + part.index(i + 3 - second)});
  }
}

void move_to_centre(TriangleMesh& mesh) {
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& vertex : mesh.vertices) bounds.extend(vertex);
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex -= bounds.center();
}

}  // namespace tagfield
