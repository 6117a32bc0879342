// SPDX-License-Identifier: Apache-2.0
#include "tagfield/world/triangulate.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>
#include <utility>

#include "tagfield/base/units.h"
#include "tagfield/world/test/mesh_volume.h"

namespace tagfield {
namespace {

/// Closed and consistently oriented: each directed edge once, and its opposite once.
bool is_closed(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& [a, b, c] : mesh.triangles) {
    ++edges[{a, b}];
    ++edges[{b, c}];
    ++edges[{c, a}];
  }
  for (const auto& [edge, count] : edges) {
    const auto opposite = edges.find({edge.second, edge.first});
    if (count != 1 || opposite == edges.end() || opposite->second != 1) return false;
  }
  return !edges.empty();
}

/// For a convex solid around the origin, every face points away from it.
bool faces_look_outward(const TriangleMesh& mesh) {
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d normal =
        (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
    if (normal.dot(mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) <= 0.0) return false;
  }
  return true;
}

/// Area of the regular polygon inscribed in a circle.
double polygon_area(double radius) {
  return 0.5 * kCircleEdges * radius * radius * std::sin(kTwoPi / kCircleEdges);
}

/// The inscribed polyhedron as a stack of frustums between similar polygons.
double inscribed_sphere_volume(double radius) {
  const int bands = kCircleEdges / 2;
  double sum = 0.0;
  for (int band = 0; band < bands; ++band) {
    const double low = kPi * band / bands;
    const double high = kPi * (band + 1) / bands;
    const double lower = polygon_area(radius * std::sin(low));
    const double upper = polygon_area(radius * std::sin(high));
    const double height = radius * (std::cos(low) - std::cos(high));
    sum += height / 3.0 * (lower + upper + std::sqrt(lower * upper));
  }
  return sum;
}

double any_size(int seed) { return 1e-3 * seed; }

const auto kSizes = [] { return rc::gen::inRange(1, 100000); };

void check_solid(const Shape& shape, double expected_volume) {
  const TriangleMesh mesh = triangulate(shape);
  RC_ASSERT(is_closed(mesh));
  RC_ASSERT(faces_look_outward(mesh));
  RC_ASSERT(std::abs(volume(mesh) / expected_volume - 1.0) < 1e-9);
  RC_ASSERT(mesh.triangles.size() == triangle_count(shape));
}

RC_GTEST_PROP(Triangulate, BoxIsClosedAndHoldsItsVolume, ()) {
  const Eigen::Vector3d size(any_size(*kSizes()), any_size(*kSizes()), any_size(*kSizes()));
  check_solid(Box{size}, size.prod());
}

RC_GTEST_PROP(Triangulate, CylinderIsClosedAndHoldsTheInscribedPrism, ()) {
  const Cylinder cylinder{any_size(*kSizes()), any_size(*kSizes())};
  check_solid(cylinder, polygon_area(cylinder.radius) * cylinder.length);
}

RC_GTEST_PROP(Triangulate, SphereIsClosedAndHoldsTheInscribedPolyhedron, ()) {
  const Sphere sphere{any_size(*kSizes())};
  check_solid(sphere, inscribed_sphere_volume(sphere.radius));
}

TEST(Triangulate, BoxHasEightCornersAndTwelveTriangles) {
  const TriangleMesh mesh = triangulate(Box{{2.0, 4.0, 6.0}});
  EXPECT_EQ(mesh.vertices.size(), 8U);
  EXPECT_EQ(mesh.triangles.size(), 12U);
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    EXPECT_EQ(vertex.cwiseAbs(), Eigen::Vector3d(1.0, 2.0, 3.0));
  }
}

TEST(Triangulate, SphereVerticesLieOnTheSphere) {
  for (const Eigen::Vector3d& vertex : triangulate(Sphere{2.0}).vertices) {
    EXPECT_NEAR(vertex.norm(), 2.0, 1e-12);
  }
  // The true sphere is slightly larger: (2/3)(π/16)² is 2.6 %, to first order.
  EXPECT_NEAR(volume(triangulate(Sphere{1.0})) / (4.0 / 3.0 * kPi), 1.0, 0.03);
}

TEST(Triangulate, CylinderStandsAlongZ) {
  for (const Eigen::Vector3d& vertex : triangulate(Cylinder{0.5, 3.0}).vertices) {
    EXPECT_EQ(std::abs(vertex.z()), 1.5);
    EXPECT_LE(vertex.head<2>().norm(), 0.5 + 1e-12);
  }
}

TEST(Triangulate, PlaneIsItsSizeAcrossItsNormal) {
  const Eigen::Vector3d normal = Eigen::Vector3d(1.0, -2.0, 0.5).normalized();
  const TriangleMesh mesh = triangulate(Plane{normal, {3.0, 4.0}});
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (const auto& [a, b, c] : mesh.triangles) {
    area += 0.5 * (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
  }
  EXPECT_EQ(mesh.triangles.size(), triangle_count(Plane{}));
  EXPECT_LT((area - 12.0 * normal).norm(), 1e-12);
}

TEST(Triangulate, PlaneFacingUpHasItsSizeAlongXAndY) {
  const TriangleMesh mesh = triangulate(Plane{Eigen::Vector3d::UnitZ(), {3.0, 4.0}});
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    EXPECT_LT((vertex.cwiseAbs() - Eigen::Vector3d(1.5, 2.0, 0.0)).norm(), 1e-12);
  }
}

TEST(Triangulate, PlaneFacingDownIsTurnedOver) {
  const TriangleMesh mesh = triangulate(Plane{-Eigen::Vector3d::UnitZ(), {1.0, 1.0}});
  const auto& [a, b, c] = mesh.triangles.front();
  const Eigen::Vector3d normal =
      (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
  EXPECT_LT((normal + Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(Triangulate, MeshIsItself) {
  const auto mesh = std::make_shared<const TriangleMesh>(triangulate(Box{{1.0, 1.0, 1.0}}));
  EXPECT_EQ(triangulate(MeshPtr(mesh)).triangles, mesh->triangles);
  EXPECT_EQ(triangle_count(MeshPtr(mesh)), 12U);
  EXPECT_EQ(triangle_count(MeshPtr()), 0U);
  EXPECT_TRUE(triangulate(MeshPtr()).triangles.empty());
}

}  // namespace
}  // namespace tagfield
