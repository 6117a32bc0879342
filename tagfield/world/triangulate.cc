#include "tagfield/world/triangulate.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

using Index = std::uint32_t;

constexpr Index kEdges = kCircleEdges;
/// A sphere's bands from pole to pole, each as high in angle as the meridians lie apart.
constexpr Index kBands = kEdges / 2;

Eigen::Vector3d on_circle(double radius, Index edge, double z) {
  const double angle = kTwoPi * edge / kEdges;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

void add_circle(TriangleMesh& mesh, double radius, double z) {
  for (Index edge = 0; edge < kEdges; ++edge) mesh.vertices.push_back(on_circle(radius, edge, z));
}

/// The wall between two circles of vertices that start at `lower` and `upper`, seen from outside.
void add_wall(TriangleMesh& mesh, Index lower, Index upper) {
  for (Index edge = 0; edge < kEdges; ++edge) {
    const Index next = (edge + 1) % kEdges;
    mesh.triangles.push_back({lower + edge, lower + next, upper + next});
    mesh.triangles.push_back({lower + edge, upper + next, upper + edge});
  }
}

/// A fan from `apex` to a circle of vertices, seen from above or from below.
void add_fan(TriangleMesh& mesh, Index apex, Index circle, bool from_above) {
  for (Index edge = 0; edge < kEdges; ++edge) {
    const Index first = circle + edge;
    const Index second = circle + (edge + 1) % kEdges;
    if (from_above) {
      mesh.triangles.push_back({apex, first, second});
    } else {
      mesh.triangles.push_back({apex, second, first});
    }
  }
}

/// The least rotation that turns z to `normal`, half a turn about x where that is opposite to z.
/// (Eigen's FromTwoVectors needs a singular value decomposition for that case, which takes long to
/// compile.)
Eigen::Quaterniond from_z_to(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d n = normal.normalized();
  if (n.z() < -1.0 + 1e-12) return {0.0, 1.0, 0.0, 0.0};
  return Eigen::Quaterniond(1.0 + n.z(), -n.y(), n.x(), 0.0).normalized();
}

struct Triangulate {
  TriangleMesh operator()(const Box& box) const {
    TriangleMesh mesh;
    // Vertex i has its x, y, z on the far side where bit 0, 1, 2 of i is set.
    for (Index i = 0; i < 8; ++i) {
      const Eigen::Vector3d corner(i & 1U ? 0.5 : -0.5, i & 2U ? 0.5 : -0.5, i & 4U ? 0.5 : -0.5);
      mesh.vertices.emplace_back(corner.cwiseProduct(box.size));
    }
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
  }

  TriangleMesh operator()(const Cylinder& cylinder) const {
    TriangleMesh mesh;
    const double half = 0.5 * cylinder.length;
    mesh.vertices = {{0.0, 0.0, -half}, {0.0, 0.0, half}};
    add_circle(mesh, cylinder.radius, -half);
    add_circle(mesh, cylinder.radius, half);
    add_fan(mesh, 0, 2, false);
    add_wall(mesh, 2, 2 + kEdges);
    add_fan(mesh, 1, 2 + kEdges, true);
    return mesh;
  }

  TriangleMesh operator()(const Sphere& sphere) const {
    TriangleMesh mesh;
    mesh.vertices = {{0.0, 0.0, -sphere.radius}, {0.0, 0.0, sphere.radius}};
    for (Index band = 1; band < kBands; ++band) {
      const double polar = kPi * band / kBands;
      add_circle(mesh, sphere.radius * std::sin(polar), -sphere.radius * std::cos(polar));
    }
    add_fan(mesh, 0, 2, false);
    for (Index band = 1; band + 1 < kBands; ++band) {
      add_wall(mesh, 2 + (band - 1) * kEdges, 2 + band * kEdges);
    }
    add_fan(mesh, 1, 2 + (kBands - 2) * kEdges, true);
    return mesh;
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
  std::size_t operator()(const Cylinder& /*cylinder*/) const { return 4 * std::size_t{kEdges}; }
  std::size_t operator()(const Sphere& /*sphere*/) const {
    return 2 * static_cast<std::size_t>(kEdges) * (kBands - 1);
  }
  std::size_t operator()(const Plane& /*plane*/) const { return 2; }
  std::size_t operator()(const MeshPtr& mesh) const { return mesh ? mesh->triangles.size() : 0; }
};

}  // namespace

TriangleMesh triangulate(const Shape& shape) { return std::visit(Triangulate{}, shape); }

std::size_t triangle_count(const Shape& shape) { return std::visit(CountTriangles{}, shape); }

}  // namespace tagfield
