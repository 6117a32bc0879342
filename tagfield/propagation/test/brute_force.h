// SPDX-License-Identifier: Apache-2.0
/// @file
/// Brute-force ray tests: every triangle, in double precision.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "tagfield/world/scene.h"
#include "tagfield/world/world_mesh.h"

namespace tagfield {

struct TestTriangle {
  std::array<Eigen::Vector3d, 3> p;
  std::size_t solid = 0;
};

/// The triangles of all solids except planes.
inline std::vector<TestTriangle> all_triangles(const Scene& scene) {
  std::vector<TestTriangle> triangles;
  for (std::size_t solid = 0; solid < scene.collisions.size(); ++solid) {
    if (std::holds_alternative<Plane>(scene.collisions[solid].shape)) continue;
    const TriangleMesh mesh = world_mesh(scene.collisions[solid]);
    for (const auto& [a, b, c] : mesh.triangles) {
      triangles.push_back({{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]}, solid});
    }
  }
  return triangles;
}

/// Distance along a line through `origin` to the triangle, from either side (T. Möller, B.
/// Trumbore, Fast, minimum storage ray-triangle intersection, J. Graphics Tools 2(1), 1997).
inline std::optional<double> moeller_trumbore(const Eigen::Vector3d& origin,
                                              const Eigen::Vector3d& direction,
                                              const TestTriangle& triangle) {
  const Eigen::Vector3d e1 = triangle.p[1] - triangle.p[0];
  const Eigen::Vector3d e2 = triangle.p[2] - triangle.p[0];
  const Eigen::Vector3d h = direction.cross(e2);
  const double det = e1.dot(h);
  if (det == 0.0) return std::nullopt;
  const Eigen::Vector3d s = origin - triangle.p[0];
  const double u = s.dot(h) / det;
  const Eigen::Vector3d q = s.cross(e1);
  const double v = direction.dot(q) / det;
  if (u < 0.0 || v < 0.0 || u + v > 1.0) return std::nullopt;
  return e2.dot(q) / det;
}

/// Whether a triangle is strictly between the points, `skip` [m] away from both.
inline bool is_blocked(const std::vector<TestTriangle>& triangles, const Eigen::Vector3d& from,
                       const Eigen::Vector3d& to, double skip) {
  const double length = (to - from).norm();
  const Eigen::Vector3d direction = (to - from) / length;
  for (const TestTriangle& triangle : triangles) {
    const auto t = moeller_trumbore(from, direction, triangle);
    if (t && *t > skip && *t < length - skip) return true;
  }
  return false;
}

}  // namespace tagfield
