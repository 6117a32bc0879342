// SPDX-License-Identifier: Apache-2.0
#include "tagfield/world/ray_scene.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <thread>

#include "tagfield/base/test/error_text.h"
#include "tagfield/base/units.h"
#include "tagfield/world/triangulate.h"

namespace tagfield {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();
constexpr float kFar = 1000.0F;

Scene scene_of(const Shape& shape, const RigidTransform& X_WC = {}) {
  Scene scene;
  scene.collisions = {{"model::link::collision", shape, X_WC}};
  return scene;
}

Ray ray_of(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, float max_m = kFar) {
  return {origin.cast<float>(), direction.normalized().cast<float>(), max_m};
}

/// Both functions, which must agree.
float distance_of(const RayScene& rays, const Ray& ray) {
  std::vector<float> distances;
  rays.distances({ray}, distances);
  const float one = rays.distance(ray);
  EXPECT_EQ(distances.size(), 1U);
  if (one != distances[0]) {
    EXPECT_NEAR(one, distances[0], 1e-5F * (1.0F + one));
  }
  return one;
}

TEST(RayScene, MeetsABoxFromOutsideAndInside) {
  const RayScene rays(scene_of(Box{{2.0, 4.0, 6.0}}, from_translation({10.0, 0.0, 0.0})));
  EXPECT_NEAR(distance_of(rays, ray_of({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0})), 9.0, 1e-5);
  EXPECT_NEAR(distance_of(rays, ray_of({30.0, 1.0, 2.0}, {-1.0, 0.0, 0.0})), 19.0, 1e-5);
  EXPECT_NEAR(distance_of(rays, ray_of({10.0, 0.0, 0.0}, {0.0, 1.0, 0.0})), 2.0, 1e-5);
  EXPECT_NEAR(distance_of(rays, ray_of({10.0, 0.0, 0.0}, {1.0, 1.0, 0.0})), std::sqrt(2.0), 1e-5);
  EXPECT_EQ(distance_of(rays, ray_of({0.0, 0.0, 0.0}, {-1.0, 0.0, 0.0})), kNothing);
  EXPECT_EQ(distance_of(rays, ray_of({0.0, 2.5, 0.0}, {1.0, 0.0, 0.0})), kNothing);
}

TEST(RayScene, GoesNoFurtherThanAsked) {
  const RayScene rays(scene_of(Box{{2.0, 2.0, 2.0}}, from_translation({10.0, 0.0, 0.0})));
  EXPECT_EQ(distance_of(rays, ray_of({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 8.99F)), kNothing);
  EXPECT_NEAR(distance_of(rays, ray_of({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 9.01F)), 9.0, 1e-5);
  EXPECT_NEAR(distance_of(rays, ray_of({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, kNothing)), 9.0, 1e-5);
  EXPECT_EQ(distance_of(rays, ray_of({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, -1.0F)), kNothing);
}

TEST(RayScene, AnEmptyWorldAnswersNothing) {
  const RayScene rays{Scene{}};
  EXPECT_EQ(distance_of(rays, ray_of({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0})), kNothing);
  std::vector<float> distances{1.0F, 2.0F};
  rays.distances({}, distances);
  EXPECT_TRUE(distances.empty());
}

TEST(RayScene, RaysThatAreNotFiniteMeetNothing) {
  Scene scene = scene_of(Box{{2.0, 2.0, 2.0}});
  scene.collisions.push_back({"ground", Plane{}, from_translation({0.0, 0.0, -5.0})});
  const RayScene rays(scene);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float bad : {nan, kNothing, -kNothing}) {
    for (int axis = 0; axis < 3; ++axis) {
      Ray ray = ray_of({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0});
      ray.origin[axis] = bad;
      EXPECT_EQ(distance_of(rays, ray), kNothing);
      ray = ray_of({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0});
      ray.direction[axis] = bad;
      EXPECT_EQ(distance_of(rays, ray), kNothing);
    }
  }
  EXPECT_EQ(distance_of(rays, ray_of({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, nan)), kNothing);
}

TEST(RayScene, ABadRayLeavesItsNeighboursAlone) {
  const RayScene rays(scene_of(Box{{2.0, 2.0, 2.0}}));
  std::vector<Ray> many(37, ray_of({-3.0, 0.0, 0.0}, {1.0, 0.0, 0.0}));
  for (std::size_t i = 0; i < many.size(); i += 5) many[i].origin.x() = std::nanf("");
  std::vector<float> distances;
  rays.distances(many, distances);
  for (std::size_t i = 0; i < many.size(); ++i) {
    EXPECT_FLOAT_EQ(distances[i], i % 5 == 0 ? kNothing : 2.0F) << i;
  }
}

TEST(RayScene, MeetsTheInscribedPolyhedronOfASphere) {
  const double radius = 2.0;
  const RayScene rays(scene_of(Sphere{radius}, from_translation({1.0, 2.0, 3.0})));
  // A chord's midpoint is nearest to the centre: no facet is nearer than that of two crossed
  // chords.
  const double half = kPi / kCircleEdges;
  const double inner = radius * std::cos(half) * std::cos(half);
  for (int i = 0; i < 500; ++i) {
    const double z = -1.0 + 2.0 * (i + 0.5) / 500.0;
    const double angle = 2.399963 * i;
    const Eigen::Vector3d outward(std::sqrt(1.0 - z * z) * std::cos(angle),
                                  std::sqrt(1.0 - z * z) * std::sin(angle), z);
    const Eigen::Vector3d centre(1.0, 2.0, 3.0);
    const double inside = distance_of(rays, ray_of(centre, outward));
    EXPECT_LE(inside, radius + 1e-5);
    EXPECT_GE(inside, inner - 1e-5);
    const double outside = distance_of(rays, ray_of(centre + 10.0 * outward, -outward));
    EXPECT_NEAR(inside + outside, 10.0, 1e-4);
  }
}

TEST(RayScene, MeetsACylindersFlatsAndCorners) {
  const RayScene rays(scene_of(Cylinder{1.0, 4.0}));
  for (int edge = 0; edge < 2 * kCircleEdges; ++edge) {
    const double angle = kPi * edge / kCircleEdges;
    const double expected = edge % 2 == 0 ? 1.0 : std::cos(kPi / kCircleEdges);
    const Eigen::Vector3d outward(std::cos(angle), std::sin(angle), 0.0);
    EXPECT_NEAR(distance_of(rays, ray_of({0.0, 0.0, 0.3}, outward)), expected, 1e-5);
  }
  EXPECT_NEAR(distance_of(rays, ray_of({0.2, 0.1, 5.0}, {0.0, 0.0, -1.0})), 3.0, 1e-5);
}

TEST(RayScene, APlaneIsEndlessAndSeenFromBothSides) {
  // Its size, 1 m, is only the extent to draw.
  const RayScene rays(scene_of(Plane{}, from_translation({0.0, 0.0, 1.0})));
  const Eigen::Vector3d down = Eigen::Vector3d(1.0, 0.0, -0.01).normalized();
  EXPECT_NEAR(distance_of(rays, ray_of({0.0, 0.0, 3.0}, down)), 2.0 / -down.z(), 1e-3);
  EXPECT_NEAR(distance_of(rays, ray_of({500.0, 0.0, 0.0}, {0.0, 0.0, 1.0})), 1.0, 1e-5);
  EXPECT_EQ(distance_of(rays, ray_of({0.0, 0.0, 3.0}, {1.0, 0.0, 0.0})), kNothing);
  EXPECT_EQ(distance_of(rays, ray_of({0.0, 0.0, 3.0}, {0.0, 0.0, 1.0})), kNothing);
  EXPECT_EQ(distance_of(rays, ray_of({0.0, 0.0, 3.0}, {0.0, 0.0, -1.0}, 1.99F)), kNothing);
  // A ray in the plane is parallel to it.
  EXPECT_EQ(distance_of(rays, ray_of({0.0, 0.0, 1.0}, {1.0, 0.0, 0.0})), kNothing);
}

RC_GTEST_PROP(RayScene, MeetsAnyPlaneWhereTheFormulaSays, ()) {
  const auto any = [](int most) { return 0.01 * *rc::gen::inRange(-100 * most, 100 * most); };
  const Eigen::Vector3d normal(any(1), any(1), any(1));
  const Eigen::Vector3d direction = Eigen::Vector3d(any(1), any(1), any(1));
  RC_PRE(normal.norm() > 0.1 && direction.norm() > 0.1);
  const RigidTransform X_WC = from_xyz_rpy({any(20), any(20), any(20)}, {any(3), any(3), any(3)});
  const Ray ray = ray_of({any(20), any(20), any(20)}, direction);
  // In the plane's own frame.
  const Eigen::Vector3d p_C = X_WC.inverse() * ray.origin.cast<double>();
  const Eigen::Vector3d d_C = X_WC.rotation.conjugate() * ray.direction.cast<double>();
  const double slope = normal.dot(d_C) / normal.norm();
  RC_PRE(std::abs(slope) > 0.02 && std::abs(normal.dot(p_C)) > 1e-3);
  const double expected = -normal.dot(p_C) / normal.norm() / slope;
  const RayScene rays(scene_of(Plane{normal, {1.0, 1.0}}, X_WC));
  const float distance = distance_of(rays, ray);
  if (expected < 0.0 || expected > ray.max_m) {
    RC_ASSERT(distance == kNothing);
  } else {
    RC_ASSERT(std::abs(distance - expected) < 1e-4 * (1.0 + expected));
  }
}

TEST(RayScene, TheNearerOfPlaneAndSolidCounts) {
  Scene scene = scene_of(Box{{2.0, 2.0, 2.0}}, from_translation({0.0, 0.0, 1.0}));
  scene.collisions.push_back({"ground", Plane{}, {}});
  const RayScene rays(scene);
  EXPECT_NEAR(distance_of(rays, ray_of({0.0, 0.0, 5.0}, {0.0, 0.0, -1.0})), 3.0, 1e-5);
  EXPECT_NEAR(distance_of(rays, ray_of({4.0, 0.0, 5.0}, {0.0, 0.0, -1.0})), 5.0, 1e-5);
}

TEST(RayScene, NoRaySlipsThroughAnEdgeOrACorner) {
  // From inside, every ray must hit the box, including those at its edges and corners. Rotated and
  // moved, so that corners are not round numbers.
  const RigidTransform X_WC = from_xyz_rpy({0.3, -7.1, 2.2}, {0.4, 0.2, 1.1});
  const Eigen::Vector3d half(1.5, 2.5, 0.7);
  const RayScene rays(scene_of(Box{2.0 * half}, X_WC));
  std::vector<Ray> many;
  std::vector<double> expected;
  const auto aim = [&](const Eigen::Vector3d& from_C, const Eigen::Vector3d& to_C) {
    many.push_back(ray_of(X_WC * from_C, X_WC.rotation * (to_C - from_C)));
    expected.push_back((to_C - from_C).norm());
  };
  for (int origin = 0; origin < 20; ++origin) {
    const Eigen::Vector3d from_C = half.cwiseProduct(Eigen::Vector3d(
        0.7 * std::sin(1.0 + origin), 0.7 * std::sin(2.3 * origin), 0.7 * std::sin(0.9 * origin)));
    for (int step = 0; step <= 500; ++step) {
      const double s = -1.0 + step / 250.0;
      for (const double u : {-1.0, 1.0}) {
        for (const double v : {-1.0, 1.0}) {
          aim(from_C, half.cwiseProduct(Eigen::Vector3d(s, u, v)));
          aim(from_C, half.cwiseProduct(Eigen::Vector3d(u, s, v)));
          aim(from_C, half.cwiseProduct(Eigen::Vector3d(u, v, s)));
        }
        // The diagonals that split each side into two triangles.
        aim(from_C, half.cwiseProduct(Eigen::Vector3d(s, s, u)));
        aim(from_C, half.cwiseProduct(Eigen::Vector3d(s, -s, u)));
        aim(from_C, half.cwiseProduct(Eigen::Vector3d(s, u, s)));
        aim(from_C, half.cwiseProduct(Eigen::Vector3d(s, u, -s)));
        aim(from_C, half.cwiseProduct(Eigen::Vector3d(u, s, s)));
        aim(from_C, half.cwiseProduct(Eigen::Vector3d(u, s, -s)));
      }
    }
  }
  std::vector<float> distances;
  rays.distances(many, distances);
  int slipped = 0;
  for (std::size_t i = 0; i < many.size(); ++i) {
    const float one = rays.distance(many[i]);
    if (!(std::abs(distances[i] - expected[i]) < 1e-4) || !(std::abs(one - expected[i]) < 1e-4)) {
      ++slipped;
    }
  }
  EXPECT_GT(many.size(), 200'000U);
  EXPECT_EQ(slipped, 0);
}

/// The intersection of a ray and a triangle (Möller and Trumbore, 1997), in double precision.
struct Crossing {
  double distance = std::numeric_limits<double>::infinity();
  double rim = std::numeric_limits<double>::infinity();  ///< To the nearest edge, barycentric.
};

Crossing crossing(const Ray& ray, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                  const Eigen::Vector3d& c) {
  const Eigen::Vector3d origin = ray.origin.cast<double>();
  const Eigen::Vector3d direction = ray.direction.cast<double>();
  const Eigen::Vector3d p = direction.cross(c - a);
  const double determinant = (b - a).dot(p);
  if (std::abs(determinant) < 1e-12) return {std::numeric_limits<double>::infinity(), 0.0};
  const Eigen::Vector3d q = (origin - a).cross(b - a);
  const double u = (origin - a).dot(p) / determinant;
  const double v = direction.dot(q) / determinant;
  const double t = (c - a).dot(q) / determinant;
  const double inside = std::min({u, v, 1.0 - u - v});
  // Far from the planes through all three edges, the triangle's slope doesn't matter.
  Crossing result;
  result.rim = std::min(std::abs(inside), std::abs(t));
  if (inside >= 0.0 && t >= 0.0) result.distance = t;
  return result;
}

/// The nearest hit over all triangles of a mesh, tested one by one.
Crossing brute_force(const Ray& ray, const TriangleMesh& mesh) {
  Crossing nearest;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Crossing one = crossing(ray, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
    nearest.rim = std::min(nearest.rim, one.rim);
    nearest.distance = std::min(nearest.distance, one.distance);
  }
  return nearest;
}

Eigen::Vector3d any_point(double most) {
  const auto any = [most] { return most * 1e-4 * *rc::gen::inRange(-10000, 10000); };
  const double x = any();
  const double y = any();
  // Vertices rounded as for Embree, so that the two differ only in arithmetic.
  return Eigen::Vector3d(x, y, any()).cast<float>().cast<double>();
}

RC_GTEST_PROP(RayScene, IsTheNearestOfAllTriangles, ()) {
  auto mesh = std::make_shared<TriangleMesh>();
  const auto count = *rc::gen::inRange<std::uint32_t>(1, 40);
  for (std::uint32_t i = 0; i < 3 * count; ++i) mesh->vertices.push_back(any_point(5.0));
  for (std::uint32_t i = 0; i < count; ++i) {
    // Some triangles share vertices.
    mesh->triangles.push_back({3 * i, 3 * i + 1, *rc::gen::inRange<std::uint32_t>(0, 3 * count)});
  }
  const RayScene rays(scene_of(MeshPtr(mesh)));
  std::vector<Ray> many;
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d origin = any_point(6.0);
    const Eigen::Vector3d direction = any_point(5.0) - origin;
    RC_PRE(direction.norm() > 0.1);
    many.push_back(ray_of(origin, direction, 30.0F));
  }
  std::vector<float> distances;
  rays.distances(many, distances);
  for (std::size_t i = 0; i < many.size(); ++i) {
    const Crossing expected = brute_force(many[i], *mesh);
    if (expected.rim < 1e-4) continue;  // Either answer is correct at an edge.
    for (const float distance : {rays.distance(many[i]), distances[i]}) {
      if (std::isinf(expected.distance)) {
        RC_ASSERT(distance == kNothing);
      } else {
        RC_ASSERT(std::abs(distance - expected.distance) < 1e-5);
      }
    }
  }
}

RC_GTEST_PROP(RayScene, IsExactWhereRaysGrazeThinTriangles, ()) {
  // As along a wall of long thin triangles, far from the origin.
  auto mesh = std::make_shared<TriangleMesh>();
  const Eigen::Vector3d a = any_point(50.0);
  const Eigen::Vector3d along = any_point(1.0);
  RC_PRE(along.norm() > 0.1);
  const Eigen::Vector3d b = a + 10.0 * along.normalized();
  const Eigen::Vector3d c = 0.5 * (a + b) + any_point(0.3);
  for (const auto& p : {a, b, c}) mesh->vertices.push_back(p.cast<float>().cast<double>());
  mesh->triangles = {{0, 1, 2}};
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  RC_PRE(normal.norm() > 0.3);
  const RayScene rays(scene_of(MeshPtr(mesh)));
  for (int i = 0; i < 100; ++i) {
    const double slope = 1e-3 * *rc::gen::inRange(1, 100);
    const double u = 0.01 * *rc::gen::inRange(0, 120);
    const double v = 0.01 * *rc::gen::inRange(0, 120);
    const Eigen::Vector3d direction = (b - a).normalized() + slope * normal.normalized();
    const Eigen::Vector3d target = a + u * (b - a) + v * (c - a);
    const Ray ray = ray_of(target - 10.0 * direction, direction, 30.0F);
    const Crossing expected = brute_force(ray, *mesh);
    if (expected.rim < 0.02) continue;  // Either answer is correct near an edge.
    const float distance = distance_of(rays, ray);
    if (std::isinf(expected.distance)) {
      RC_ASSERT(distance == kNothing);
    } else {
      RC_ASSERT(std::abs(distance - expected.distance) < 1e-5);
    }
  }
}

TEST(RayScene, ManyThreadsGetTheSameAnswers) {
  const RayScene rays(scene_of(Sphere{2.0}));
  std::vector<Ray> many;
  for (int i = 0; i < 1000; ++i) {
    many.push_back(ray_of({0.1, 0.2, 0.3}, {std::cos(0.1 * i), std::sin(0.1 * i), 0.001 * i}));
  }
  std::vector<float> alone;
  rays.distances(many, alone);
  std::vector<std::vector<float>> together(4);
  std::vector<std::thread> threads;
  for (auto& distances : together) {
    threads.emplace_back([&rays, &many, &distances] { rays.distances(many, distances); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& distances : together) EXPECT_EQ(distances, alone);
}

TEST(RayScene, MovesWithItsWorld) {
  RayScene first(scene_of(Box{{2.0, 2.0, 2.0}}));
  const RayScene second = std::move(first);
  EXPECT_NEAR(distance_of(second, ray_of({-3.0, 0.0, 0.0}, {1.0, 0.0, 0.0})), 2.0, 1e-5);
}

TEST(RayScene, RefusesBadShapes) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto message = [](const Shape& shape) {
    return error_of([&] { RayScene{scene_of(shape)}; });
  };
  EXPECT_TRUE(contains(message(Box{{nan, 1.0, 1.0}}), "model::link::collision: a vertex at"));
  EXPECT_TRUE(contains(message(Box{{1e12, 1.0, 1.0}}), "is not within"));
  EXPECT_TRUE(contains(message(Plane{Eigen::Vector3d::Zero()}), "has no direction"));
  EXPECT_TRUE(contains(message(Plane{{nan, 0.0, 1.0}}), "has no direction"));
  const TriangleMesh torn{{Eigen::Vector3d::Zero()}, {{0, 0, 1}}};
  EXPECT_TRUE(contains(message(std::make_shared<const TriangleMesh>(torn)), "is not there"));
  EXPECT_EQ(message(MeshPtr()), "(no error)");
}

}  // namespace
}  // namespace tagfield
