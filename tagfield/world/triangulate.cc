// SPDX-License-Identifier: Apache-2.0
#include "tagfield/world/triangulate.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>

#include "tagfield/world/internal/revolution.h"

namespace tagfield {
namespace {

using Index = std::uint32_t;

/// The smallest rotation that turns z to `normal`; by π about x if that is opposite to z. (Eigen's
/// FromTwoVectors needs a singular value decomposition for that case, which is slow to compile.)
Eigen::Quaterniond from_z_to(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d n = normal.normalized();
  if (n.z() < -1.0 + 1e-12) return {0.0, 1.0, 0.0, 0.0};
  return Eigen::Quaterniond(1.0 + n.z(), -n.y(), n.x(), 0.0).normalized();
}

struct Triangulate {
  TriangleMesh operator()(const Box& box) const {
    TriangleMesh mesh;
    // Bits 0, 1 and 2 of i select the positive side in x, y and z for vertex i.
    for (Index i = 0; i < 8; ++i) {
      const Eigen::Vector3d corner(i & 1U ? 0.5 : -0.5, i & 2U ? 0.5 : -0.5, i & 4U ? 0.5 : -0.5);
      mesh.vertices.emplace_back(corner.cwiseProduct(box.size));
    }
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
  }

  TriangleMesh operator()(const Cylinder& cylinder) const {
    const double half = 0.5 * cylinder.length;
    return solid_of_revolution(-half, half, {{cylinder.radius, -half}, {cylinder.radius, half}});
  }

  TriangleMesh operator()(const Sphere& sphere) const {
    return solid_of_revolution(-sphere.radius, sphere.radius, sphere_rings(sphere.radius));
  }

  TriangleMesh operator()(const Plane& plane) const {
    const Eigen::Quaterniond R = from_z_to(plane.normal);
    const Eigen::Vector3d u = R * Eigen::Vector3d(0.5 * plane.size.x(), 0.0, 0.0);
    const Eigen::Vector3d v = R * Eigen::Vector3d(0.0, 0.5 * plane.size.y(), 0.0);
    return {{-u - v, u - v, u + v, -u + v}, {{0, 1, 2}, {0, 2, 3}}};
  }

  TriangleMesh operator()(const MeshPtr& mesh) const { return mesh ? *mesh : TriangleMesh{}; }
};

struct CountTriangles {
  std::size_t operator()(const Box& /*box*/) const { return 12; }
  std::size_t operator()(const Cylinder& /*cylinder*/) const {
    return 4 * std::size_t{kCircleEdges};
  }
  std::size_t operator()(const Sphere& /*sphere*/) const {
    return 2 * std::size_t{kCircleEdges} * (kCircleEdges / 2 - 1);
  }
  std::size_t operator()(const Plane& /*plane*/) const { return 2; }
  std::size_t operator()(const MeshPtr& mesh) const { return mesh ? mesh->triangles.size() : 0; }
};

}  // namespace

TriangleMesh triangulate(const Shape& shape) { return std::visit(Triangulate{}, shape); }

std::size_t triangle_count(const Shape& shape) { return std::visit(CountTriangles{}, shape); }

}  // namespace tagfield
