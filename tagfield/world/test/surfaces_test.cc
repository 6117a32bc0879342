// SPDX-License-Identifier: Apache-2.0
// RayScene::surfaces() against each triangle, in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tagfield/world/ray_scene.h"
#include "tagfield/world/world_mesh.h"

namespace tagfield {
namespace {

Scene three_shapes() {
  Scene scene;
  scene.collisions = {
      {"ball", Sphere{1.5}, from_translation({0.5, 0.2, 0.1})},
      {"floor", Plane{{0.1, 0.2, 1.0}, {1.0, 1.0}}, from_translation({0.0, 0.0, -1.0})},
      {"box", Box{{1.0, 2.0, 3.0}}, from_xyz_rpy({-1.0, 1.0, 0.0}, {0.3, 0.2, 0.1})},
      {"pipe", Cylinder{0.7, 4.0}, from_xyz_rpy({1.0, -1.0, 0.0}, {1.0, 0.4, 0.0})}};
  return scene;
}

struct Expected {
  double distance = 0.0;
  std::uint32_t collision = 0;
  std::uint32_t triangle = 0;
};

/// The line's hit with one triangle, by solving for the point in its plane, if there is one. Sets
/// `near_rim` if the line passes very close to an edge.
void add_hit(const std::array<Eigen::Vector3d, 3>& p, const RaySegment& segment, Expected hit,
             std::vector<Expected>& hits, bool& near_rim) {
  Eigen::Matrix3d system;
  system << p[1] - p[0], p[2] - p[0], -segment.direction;
  const Eigen::Vector3d solved = system.inverse() * (segment.origin - p[0]);
  const double inside = std::min({solved[0], solved[1], 1.0 - solved[0] - solved[1]});
  if (std::abs(inside) < 1e-3) near_rim = true;
  hit.distance = solved[2];
  if (inside >= 0.0 && hit.distance >= segment.from_m && hit.distance <= segment.to_m) {
    hits.push_back(hit);
  }
}

std::vector<Expected> brute_force(const Scene& scene, const RaySegment& segment, bool& near_rim) {
  std::vector<Expected> hits;
  for (std::uint32_t i = 0; i < scene.collisions.size(); ++i) {
    const Collision& collision = scene.collisions[i];
    if (const auto* plane = std::get_if<Plane>(&collision.shape)) {
      const Eigen::Vector3d n = plane->normal.normalized();
      const double t =
          n.dot(collision.X_WC.translation - segment.origin) / n.dot(segment.direction);
      if (t >= segment.from_m && t <= segment.to_m) hits.push_back({t, i, 0});
      continue;
    }
    const TriangleMesh mesh = world_mesh(collision);
    for (std::uint32_t k = 0; k < mesh.triangles.size(); ++k) {
      const auto& [a, b, c] = mesh.triangles[k];
      add_hit({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]}, segment, {0.0, i, k}, hits,
              near_rim);
    }
  }
  return hits;
}

TEST(Surfaces, AreThoseOfEveryTriangleToTheLastDigits) {
  const Scene scene = three_shapes();
  const RayScene rays(scene);
  std::mt19937 random(5);
  std::normal_distribution<double> any(0.0, 2.0);
  std::vector<SurfaceHit> hits;
  std::size_t count = 0;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3d from(any(random), any(random), any(random));
    const Eigen::Vector3d to(any(random), any(random), any(random));
    const RaySegment segment{from, (to - from).normalized(), -0.5, (to - from).norm()};
    bool near_rim = false;
    const std::vector<Expected> expected = brute_force(scene, segment, near_rim);
    if (near_rim) continue;
    EXPECT_TRUE(rays.surfaces(segment, {}, hits));
    EXPECT_EQ(hits.size(), expected.size()) << i;
    for (const Expected& one : expected) {
      ++count;
      const auto same = std::find_if(hits.begin(), hits.end(), [&](const SurfaceHit& hit) {
        return hit.collision == one.collision && hit.triangle == one.triangle;
      });
      ASSERT_NE(same, hits.end()) << i;
      EXPECT_NEAR(same->distance_m, one.distance, 1e-9);
      EXPECT_NEAR(same->slope, same->normal.dot(segment.direction), 1e-12);
    }
  }
  EXPECT_GT(count, 2000U);
}

TEST(Surfaces, NormalsPointOutOfABox) {
  Scene scene;
  scene.collisions = {{"box", Box{{2.0, 2.0, 2.0}}, {}}};
  std::vector<SurfaceHit> hits;
  EXPECT_TRUE(RayScene(scene).surfaces({{-3.0, 0.1, 0.3}, {1.0, 0.0, 0.0}, 0.0, 9.0}, {}, hits));
  ASSERT_EQ(hits.size(), 2U);
  if (hits[0].distance_m > hits[1].distance_m) std::swap(hits[0], hits[1]);
  EXPECT_DOUBLE_EQ(hits[0].slope, -1.0);
  EXPECT_DOUBLE_EQ(hits[1].slope, 1.0);
  EXPECT_DOUBLE_EQ(hits[0].distance_m, 2.0);
  EXPECT_DOUBLE_EQ(hits[1].distance_m, 4.0);
}

TEST(Surfaces, TheSearchStopsAtTheGivenLimits) {
  const RayScene rays(three_shapes());
  RaySegment segment{{-5.0, 0.3, 0.2}, {1.0, 0.0, 0.0}, 0.0, 20.0};
  std::vector<SurfaceHit> hits;
  EXPECT_FALSE(rays.surfaces(segment, {1, 0, 0, 0}, hits));
  EXPECT_TRUE(rays.surfaces(segment, {0, 0, 0, 0}, hits));
  EXPECT_FALSE(rays.surfaces({{0.0, 0.0, 5.0}, {0.0, 0.0, -1.0}, 0.0, 9.0}, {0, 1, 0, 0}, hits));
  segment.stop_from_m = 10.0;
  EXPECT_TRUE(rays.surfaces(segment, {1, 0, 0, 0}, hits));
  EXPECT_GE(hits.size(), 2U);
}

TEST(Surfaces, AStretchThatIsNotFiniteMeetsNothing) {
  const RayScene rays(three_shapes());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<SurfaceHit> hits(3);
  EXPECT_TRUE(rays.surfaces({{nan, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.0, 9.0}, {1, 1, 1, 1}, hits));
  EXPECT_TRUE(hits.empty());
  EXPECT_TRUE(rays.surfaces({{-5.0, 0.3, 0.2}, {1.0, nan, 0.0}, 0.0, 9.0}, {1, 1, 1, 1}, hits));
  EXPECT_TRUE(rays.surfaces({{-5.0, 0.3, 0.2}, {1.0, 0.0, 0.0}, nan, 9.0}, {1, 1, 1, 1}, hits));
  EXPECT_TRUE(rays.surfaces({{-5.0, 0.3, 0.2}, {1.0, 0.0, 0.0}, 0.0, nan}, {1, 1, 1, 1}, hits));
  EXPECT_TRUE(rays.surfaces({{-5.0, 0.3, 0.2}, {1.0, 0.0, 0.0}, 3.0, 2.0}, {1, 1, 1, 1}, hits));
  EXPECT_TRUE(hits.empty());
  EXPECT_TRUE(RayScene(Scene{}).surfaces({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.0, 9.0}, {}, hits));
}

}  // namespace
}  // namespace tagfield
