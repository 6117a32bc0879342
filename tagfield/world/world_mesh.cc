// SPDX-License-Identifier: Apache-2.0
#include "tagfield/world/world_mesh.h"

#include <fmt/format.h>

#include "tagfield/base/error.h"
#include "tagfield/world/triangulate.h"

namespace tagfield {
namespace {

constexpr double kMaxCoordinate = 1e9;  // [m]

}  // namespace

TriangleMesh world_mesh(const Collision& collision) {
  TriangleMesh mesh = triangulate(collision.shape);
  for (Eigen::Vector3d& p : mesh.vertices) {
    p = collision.X_WC * p;
    if (!p.allFinite() || p.cwiseAbs().maxCoeff() > kMaxCoordinate) {
      throw Error(fmt::format("{}: a vertex at ({}, {}, {}) is not within {:g} m of the origin",
                              collision.name, p.x(), p.y(), p.z(), kMaxCoordinate));
    }
  }
  const std::size_t count = mesh.vertices.size();
  for (const auto& [a, b, c] : mesh.triangles) {
    if (a >= count || b >= count || c >= count) {
      throw Error(collision.name + ": a triangle names a vertex that is not there");
    }
  }
  return mesh;
}

}  // namespace tagfield
