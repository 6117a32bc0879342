// SPDX-License-Identifier: Apache-2.0
#include "tagfield/propagation/diffraction.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "tagfield/base/units.h"
#include "tagfield/world/triangulate.h"

namespace tagfield {
namespace {

using Eigen::Vector3d;

Collision solid(const Shape& shape, const RigidTransform& X_WC = {}) {
  return {"thing::link::c", shape, X_WC};
}

RadioScene metal(const Scene& scene) {
  RadioSceneOptions options;
  options.opaque.assign(scene.collisions.size(), 1);
  return RadioScene(scene, options);
}

std::vector<DiffractingEdge> edges_of(const std::vector<Collision>& collisions) {
  Scene scene;
  scene.collisions = collisions;
  return diffracting_edges(scene, metal(scene));
}

double whole_length(const std::vector<DiffractingEdge>& edges) {
  double sum = 0.0;
  for (const DiffractingEdge& edge : edges) sum += edge.length_m;
  return sum;
}

TEST(DiffractingEdges, OfABoxAreItsTwelve) {
  const auto edges = edges_of({solid(Box{{1.0, 2.0, 3.0}})});
  ASSERT_EQ(edges.size(), 12U);
  EXPECT_NEAR(whole_length(edges), 4.0 * (1.0 + 2.0 + 3.0), 1e-9);
  for (const DiffractingEdge& edge : edges) {
    EXPECT_NEAR(edge.exterior_rad, 1.5 * kPi, 1e-9);
    EXPECT_FALSE(edge.is_sheet);
    for (const WedgeFace& face : edge.faces) EXPECT_TRUE(face.mirrors);
    // Free space is where the theory expects it: from face 0 to face 1 by the right-hand rule.
    const WedgeFace& first = edge.faces[0];
    EXPECT_NEAR((first.into_W.cross(first.normal_W) - edge.axis_W).norm(), 0.0, 1e-9);
    const double turned = -first.normal_W.dot(edge.faces[1].into_W);
    EXPECT_NEAR(turned, 1.0, 1e-9);
  }
}

TEST(DiffractingEdges, AreNeitherOnRoundThingsNorInCorners) {
  EXPECT_TRUE(edges_of({solid(Sphere{2.0})}).empty());
  EXPECT_TRUE(edges_of({solid(Cylinder{0.4, 2.0})}).empty());
  // Five of the vertical edges of an L count; the one in its inner corner is concave.
  TriangleMesh prism;
  const std::vector<Eigen::Vector2d> outline = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  for (const double z : {0.0, 1.0}) {
    for (const Eigen::Vector2d& p : outline) prism.vertices.emplace_back(p.x(), p.y(), z);
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t j = (i + 1) % 6;
    prism.triangles.push_back({i, j, j + 6});
    prism.triangles.push_back({i, j + 6, i + 6});
  }
  for (const auto& [a, b, c] : {std::array{0U, 1U, 3U}, {1U, 2U, 3U}, {0U, 3U, 5U}, {3U, 4U, 5U}}) {
    prism.triangles.push_back({a, c, b});
    prism.triangles.push_back({a + 6, b + 6, c + 6});
  }
  EXPECT_EQ(edges_of({solid(std::make_shared<const TriangleMesh>(prism))}).size(), 5U + 12U);
}

TEST(DiffractingEdges, OfAThinPlateAreItsFourBorders) {
  const auto edges = edges_of({solid(Box{{2.0, 1.0, 0.02}})});
  ASSERT_EQ(edges.size(), 4U);
  for (const DiffractingEdge& edge : edges) {
    EXPECT_NEAR(edge.exterior_rad, 2.0 * kPi, 1e-9);
    EXPECT_NEAR(edge.thickness_m, 0.02, 1e-9);
    EXPECT_NEAR(edge.from_W.z(), 0.0, 1e-9);
    EXPECT_NEAR(std::abs(edge.faces[0].normal_W.z()), 1.0, 1e-9);
    EXPECT_NEAR((edge.faces[0].normal_W + edge.faces[1].normal_W).norm(), 0.0, 1e-9);
  }
}

TEST(DiffractingEdges, StandFreeOfWhatCoversThem) {
  const Collision floor = {"floor::l::c", Plane{}, {}};
  const auto box = [](double x) {
    return solid(Box{{1.0, 1.0, 1.0}}, from_translation({x, 0.0, 0.5}));
  };
  // On the floor: four vertical ones and four on top.
  EXPECT_EQ(edges_of({floor, box(0.0)}).size(), 8U);
  // Side by side and flush: there is no edge where they touch.
  const auto two = edges_of({floor, box(0.0), box(1.0)});
  EXPECT_NEAR(whole_length(two), 4.0 + 2.0 * (2.0 + 1.0), 1e-6);
  // Inside a room that is one box, they are as free as outside.
  const Collision room = solid(Box{{9.0, 9.0, 9.0}});
  EXPECT_NEAR(whole_length(edges_of({room, box(0.0)})), 12.0 + 12.0 * 9.0, 1e-6);
  // Half covered by another box: the rest remains.
  const auto half =
      edges_of({box(0.0), solid(Box{{0.5, 1.0, 1.0}}, from_translation({0.25, 0, 1.5}))});
  const auto on_top = std::count_if(half.begin(), half.end(), [](const DiffractingEdge& edge) {
    return std::abs(edge.from_W.z() - 1.0) < 1e-9 && std::abs(edge.axis_W.x()) > 0.9;
  });
  EXPECT_EQ(on_top, 2);
}

/// Splits a triangle at a point of one side. Unless `hanging`, the adjacent triangle is split there
/// too; otherwise the point is a T-junction.
void cut(TriangleMesh& mesh, bool hanging, double share, std::size_t which, std::size_t side) {
  const auto triangle = mesh.triangles[which];
  const std::uint32_t a = triangle[side];
  const std::uint32_t b = triangle[(side + 1) % 3];
  const Vector3d p = (1.0 - share) * mesh.vertices[a] + share * mesh.vertices[b];
  const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(p);
  const std::size_t count = mesh.triangles.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (i != which && hanging) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto corners = mesh.triangles[i];
      const bool has = (corners[k] == a && corners[(k + 1) % 3] == b) ||
                       (corners[k] == b && corners[(k + 1) % 3] == a);
      if (!has) continue;
      mesh.triangles[i] = {corners[k], middle, corners[(k + 2) % 3]};
      mesh.triangles.push_back({middle, corners[(k + 1) % 3], corners[(k + 2) % 3]});
      break;
    }
  }
}

void expect_same(const std::vector<DiffractingEdge>& one,
                 const std::vector<DiffractingEdge>& other) {
  RC_ASSERT(one.size() == std::size_t{12});
  RC_ASSERT(other.size() == std::size_t{12});
  for (const DiffractingEdge& edge : one) {
    const auto same = std::find_if(other.begin(), other.end(), [&](const DiffractingEdge& e) {
      return (e.from_W - edge.from_W).norm() < 1e-6 && (e.axis_W - edge.axis_W).norm() < 1e-6 &&
             std::abs(e.length_m - edge.length_m) < 1e-6 &&
             std::abs(e.exterior_rad - edge.exterior_rad) < 1e-6 &&
             (e.faces[0].normal_W - edge.faces[0].normal_W).norm() < 1e-6 &&
             (e.faces[1].into_W - edge.faces[1].into_W).norm() < 1e-6;
    });
    RC_ASSERT(same != other.end());
  }
}

RC_GTEST_PROP(DiffractingEdges, AreTheSameHoweverABoxIsCutIntoTriangles, (bool hanging)) {
  const auto number = [](double from, double to) {
    return from + (to - from) * *rc::gen::inRange(0, 1001) * 1e-3;
  };
  const Box box{{number(0.5, 3.0), number(0.5, 3.0), number(0.5, 3.0)}};
  const RigidTransform X_WC = from_xyz_rpy({number(-3, 3), number(-3, 3), number(-3, 3)},
                                           {number(-3, 3), number(-1, 1), number(-3, 3)});
  TriangleMesh mesh = triangulate(box);
  for (int cuts = *rc::gen::inRange(1, 12); cuts > 0; --cuts) {
    const auto which = *rc::gen::inRange<std::size_t>(0, mesh.triangles.size());
    cut(mesh, hanging, number(0.2, 0.8), which, *rc::gen::inRange<std::size_t>(0, 3));
  }
  expect_same(edges_of({solid(box, X_WC)}),
              edges_of({solid(std::make_shared<const TriangleMesh>(mesh), X_WC)}));
}

TEST(TraceDiffracted, BendsWhereTheWayIsShortest) {
  Scene scene;
  scene.collisions = {solid(Box{{2.0, 2.0, 2.0}})};
  const RadioScene waves = metal(scene);
  const auto edges = diffracting_edges(scene, waves);
  std::vector<DiffractedPath> paths;
  const Vector3d p_WA(-3.0, 0.2, 1.7);
  const Vector3d p_WT(2.5, 0.4, 1.6);
  trace_diffracted(waves, edges, p_WA, p_WT, {}, paths);
  // At least over the two upper edges across the path, which both ends see. The shortest paths over
  // the four vertical edges would bend above their ends, and the lower edges are hidden.
  EXPECT_GE(paths.size(), 2U);
  for (const DiffractedPath& path : paths) {
    const DiffractingEdge& edge = edges[path.edge];
    const auto length = [&](double z) {
      const Vector3d p = path.p_W + z * edge.axis_W;
      return (p - p_WA).norm() + (p_WT - p).norm();
    };
    EXPECT_NEAR(path.length_m(), length(0.0), 1e-12);
    EXPECT_LT(length(0.0), length(1e-3));
    EXPECT_LT(length(0.0), length(-1e-3));
    // Keller's cone.
    EXPECT_NEAR(path.departure_W.dot(edge.axis_W), path.arrival_W.dot(edge.axis_W), 1e-12);
    for (const double angle : {path.antenna_rad, path.tag_rad}) {
      EXPECT_GT(angle, 0.0);
      EXPECT_LT(angle, edge.exterior_rad);
    }
  }
}

TEST(TraceDiffracted, GoesNowhereThroughMetal) {
  Scene scene;
  scene.collisions = {solid(Box{{0.01, 4.0, 4.0}}),
                      {"wall::l::c", Box{{0.1, 9.0, 9.0}}, from_translation({1.0, 0.0, 0.0})}};
  const RadioScene waves = metal(scene);
  const auto edges = diffracting_edges(scene, waves);
  std::vector<DiffractedPath> paths;
  trace_diffracted(waves, edges, {-3, 0, 0}, {0.5, 0, 0}, {}, paths);
  const auto around_plate = std::count_if(
      paths.begin(), paths.end(), [&](const auto& path) { return edges[path.edge].solid == 0; });
  EXPECT_EQ(around_plate, 4);
  trace_diffracted(waves, edges, {-3, 0, 0}, {3, 0, 0}, {}, paths);
  EXPECT_TRUE(paths.empty());  // Getting around the wall takes two edges.
  trace_diffracted(waves, edges, {-3, 0, 0}, {std::nan(""), 0, 0}, {}, paths);
  EXPECT_TRUE(paths.empty());
}

}  // namespace
}  // namespace tagfield
