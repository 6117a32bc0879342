// SPDX-License-Identifier: Apache-2.0
// Crossings of direct and reflected paths, against closed forms.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <optional>
#include <random>

#include "tagfield/propagation/trace_paths.h"
#include "tagfield/world/triangulate.h"

namespace tagfield {
namespace {

Collision box(const Eigen::Vector3d& size, const Eigen::Vector3d& centre) {
  return {"box", Box{size}, from_translation(centre)};
}

RadioScene radio_of(std::vector<Collision> collisions, bool opaque = false) {
  Scene scene;
  scene.collisions = std::move(collisions);
  RadioSceneOptions options;
  options.opaque.assign(scene.collisions.size(), opaque ? 1 : 0);
  return RadioScene(scene, options);
}

/// A square perpendicular to the x axis at `x`, facing −x unless `turned`.
Collision sheet(double x, bool turned) {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->vertices = {{0.0, -2.0, -2.0}, {0.0, 2.0, -2.0}, {0.0, 2.0, 2.0}, {0.0, -2.0, 2.0}};
  mesh->triangles = {{0, 2, 1}, {0, 3, 2}};
  if (turned) mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
  return {"sheet", MeshPtr(mesh), from_translation({x, 0.0, 0.0})};
}

RC_GTEST_PROP(Crossings, OfASlabAreItsThicknessOverTheCosine, ()) {
  const auto any = [](int low, int high) { return 1e-3 * *rc::gen::inRange(low, high); };
  const double thickness = any(1, 500);
  const RadioScene radio = radio_of({box({100.0, 100.0, thickness}, {0.0, 0.0, 0.0})});
  const Eigen::Vector3d a(any(-9000, 9000), any(-9000, 9000), any(300, 5000));
  const Eigen::Vector3d t(any(-9000, 9000), any(-9000, 9000), -any(300, 5000));
  const auto found = straight_crossings(radio, a, t);
  RC_ASSERT(found.size() == 1U);
  const Eigen::Vector3d way = (t - a).normalized();
  RC_ASSERT(found[0].solid == 0U);
  RC_ASSERT(found[0].leg == 0);
  RC_ASSERT(std::abs(found[0].cos_incidence - std::abs(way.z())) < 1e-12);
  RC_ASSERT(std::abs(found[0].length_m - thickness / std::abs(way.z())) < 1e-9);
  RC_ASSERT((found[0].normal_W - Eigen::Vector3d::UnitZ()).norm() < 1e-12);
  RC_ASSERT(std::abs(found[0].p_W.z() - 0.5 * thickness) < 1e-9);
}

/// Length of the segment from `a` to `t` inside an axis-aligned box, by the slab method (T. Kay, J.
/// Kajiya, Ray tracing complex scenes, SIGGRAPH 1986); none if it runs along a face.
std::optional<double> chord(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                            const Eigen::Vector3d& a, const Eigen::Vector3d& t) {
  double from = 0.0;
  double to = 1.0;
  for (int i = 0; i < 3; ++i) {
    const double way = t[i] - a[i];
    if (way == 0.0) {
      if (a[i] == low[i] || a[i] == high[i]) return std::nullopt;
      if (a[i] < low[i] || a[i] > high[i]) return 0.0;
      continue;
    }
    const double one = (low[i] - a[i]) / way;
    const double other = (high[i] - a[i]) / way;
    from = std::max(from, std::min(one, other));
    to = std::min(to, std::max(one, other));
  }
  return std::max(0.0, to - from) * (t - a).norm();
}

/// For paths through an edge.
RC_GTEST_PROP(Crossings, OfBoxesByTheirEdgesAreTheirChords, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  const auto round = [&](int low, int high) {
    return 0.1 * std::uniform_int_distribution<int>(low, high)(random);
  };
  TraceOptions options;
  options.mount_depth_m = 0.0;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d size(round(1, 20), round(1, 20), round(1, 20));
    const Eigen::Vector3d centre(round(-20, 20), round(-20, 20), round(-20, 20));
    const Eigen::Vector3d a(round(-40, 40), round(-40, 40), round(-40, 40));
    const Eigen::Vector3d low = centre - 0.5 * size;
    Eigen::Vector3d edge = low + 0.1 * round(0, 100) * size;
    for (const int axis : {0, 1, 2}) {
      if (axis != i % 3) edge[axis] = low[axis] + round(0, 1) * 10.0 * size[axis];
    }
    const Eigen::Vector3d t = edge + round(1, 30) * (edge - a);
    const auto truth = chord(low, centre + 0.5 * size, a, t);
    const auto is_at_face = [&](const Eigen::Vector3d& p) {
      return ((p - low).cwiseAbs().cwiseMin((p - low - size).cwiseAbs()).array() < 1e-4).any();
    };
    if (!truth || a == t || is_at_face(a) || is_at_face(t)) continue;
    double crossed = 0.0;
    for (const RadioScene radio = radio_of({box(size, centre)});
         const Crossing& crossing : straight_crossings(radio, a, t, options)) {
      crossed += crossing.length_m;
    }
    // Whether a path that grazes an edge is inside is decided to within a few micrometres.
    RC_ASSERT(std::abs(crossed - *truth) < 1e-3);
  }
}

TEST(Crossings, OfSheetsHaveNoLength) {
  for (const bool turned : {false, true}) {
    const auto found =
        straight_crossings(radio_of({sheet(1.0, turned)}), {0.0, 0.1, 0.2}, {3.0, 0.3, 0.5});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].length_m, 0.0);
    EXPECT_NEAR(found[0].p_W.x(), 1.0, 1e-12);
    EXPECT_NEAR(found[0].normal_W.x(), -1.0, 1e-12);
  }
}

TEST(Crossings, AreInOrderAndEachOnceFromEitherSide) {
  const RadioScene radio = radio_of({box({1.0, 2.0, 2.0}, {5.0, 0.0, 0.0}), sheet(1.0, false),
                                     box({0.5, 2.0, 2.0}, {2.5, 0.0, 0.0})});
  const auto there = straight_crossings(radio, {0.0, 0.1, 0.2}, {8.0, 0.1, 0.2});
  ASSERT_EQ(there.size(), 3U);
  EXPECT_EQ(there[0].solid, 1U);
  EXPECT_EQ(there[1].solid, 2U);
  EXPECT_EQ(there[2].solid, 0U);
  EXPECT_NEAR(there[1].length_m, 0.5, 1e-12);
  EXPECT_NEAR(there[2].length_m, 1.0, 1e-12);
  const auto back = straight_crossings(radio, {8.0, 0.1, 0.2}, {0.0, 0.1, 0.2});
  ASSERT_EQ(back.size(), 3U);
  EXPECT_EQ(back[0].solid, 0U);
  EXPECT_EQ(back[2].solid, 1U);
}

TEST(Crossings, OfTouchingBoxesAreTwo) {
  const RadioScene radio =
      radio_of({box({1.0, 2.0, 2.0}, {2.5, 0.0, 0.0}), box({1.0, 2.0, 2.0}, {3.5, 0.0, 0.0})});
  const auto found = straight_crossings(radio, {0.0, 0.1, 0.2}, {8.0, 0.1, 0.2});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].length_m, 1.0, 1e-9);
  EXPECT_NEAR(found[1].length_m, 1.0, 1e-9);
}

/// Boxes as one mesh.
Collision as_one_mesh(const std::vector<Collision>& boxes) {
  auto mesh = std::make_shared<TriangleMesh>();
  for (const Collision& one : boxes) {
    const TriangleMesh part = triangulate(one.shape);
    const auto first = static_cast<std::uint32_t>(mesh->vertices.size());
    for (const Eigen::Vector3d& p : part.vertices) mesh->vertices.push_back(one.X_WC * p);
    for (const auto& [a, b, c] : part.triangles) {
      mesh->triangles.push_back({first + a, first + b, first + c});
    }
  }
  return {"mesh", MeshPtr(mesh), {}};
}

TEST(Crossings, OfOneMeshJoinPartsThatTouchOrOverlap) {
  for (const double x : {3.5, 3.2, 2.6}) {
    const RadioScene radio = radio_of({as_one_mesh(
        {box({1.0, 2.0, 2.0}, {2.5, 0.0, 0.0}), box({1.0, 1.6, 1.7}, {x, 0.0, 0.0})})});
    const auto found = straight_crossings(radio, {0.0, 0.1, 0.2}, {8.0, 0.1, 0.2});
    ASSERT_EQ(found.size(), 1U) << x;
    EXPECT_NEAR(found[0].length_m, x + 0.5 - 2.0, 1e-9);
    EXPECT_NEAR(found[0].p_W.x(), 2.0, 1e-9);
  }
  const auto apart =
      straight_crossings(radio_of({as_one_mesh({box({1.0, 2.0, 2.0}, {2.5, 0.0, 0.0}),
                                                box({1.0, 1.0, 1.0}, {5.0, 0.0, 0.0})})}),
                         {0.0, 0.1, 0.2}, {8.0, 0.1, 0.2});
  EXPECT_EQ(apart.size(), 2U);
}

TEST(Crossings, ThroughADiagonalAreNotCountedTwice) {
  // The path passes through the diagonals that the triangles of both faces share.
  const RadioScene radio = radio_of({box({1.0, 2.0, 2.0}, {3.0, 0.0, 0.0})});
  for (int i = -9; i <= 9; ++i) {
    const double y = 0.1 * i;
    for (const double z : {y, -y}) {
      const auto found = straight_crossings(radio, {0.0, y, z}, {8.0, y, z});
      ASSERT_EQ(found.size(), 1U) << y;
      EXPECT_NEAR(found[0].length_m, 1.0, 1e-9);
    }
  }
}

TEST(Crossings, AnEndDeepInsideCountsFromThere) {
  const RadioScene radio = radio_of({box({2.0, 2.0, 2.0}, {3.0, 0.0, 0.0})});
  const auto in = straight_crossings(radio, {0.0, 0.1, 0.2}, {2.7, 0.1, 0.2});
  ASSERT_EQ(in.size(), 1U);
  EXPECT_NEAR(in[0].length_m, 0.7, 1e-12);
  EXPECT_NEAR(in[0].p_W.x(), 2.0, 1e-12);
  const auto out = straight_crossings(radio, {2.7, 0.1, 0.2}, {9.0, 0.1, 0.2});
  ASSERT_EQ(out.size(), 1U);
  EXPECT_NEAR(out[0].length_m, 1.3, 1e-12);
  EXPECT_NEAR(out[0].p_W.x(), 4.0, 1e-12);
  EXPECT_NEAR(out[0].normal_W.x(), -1.0, 1e-12);
  EXPECT_TRUE(straight_crossings(radio, {2.5, 0.0, 0.1}, {3.5, 0.2, 0.3}).empty());
}

/// Whether the antenna at (x, 0.3, 0.2) and the tag see each other, which must not depend on which
/// is which.
bool sees(const RadioScene& radio, double x, const Eigen::Vector3d& tag) {
  const Eigen::Vector3d antenna(x, 0.3, 0.2);
  const bool there = is_unobstructed(radio, antenna, tag);
  EXPECT_EQ(is_unobstructed(radio, tag, antenna), there) << tag.transpose();
  return there;
}

TEST(Mounting, ATagOnAFaceOrALittleInsideIsSeenFromOutsideOnly) {
  const RadioScene metal = radio_of({box({2.0, 2.0, 2.0}, {3.0, 0.0, 0.0})}, true);
  for (const double depth : {-0.005, -0.001, -1e-6, -1e-12, 0.0, 1e-12, 1e-6, 0.001, 0.01}) {
    for (const double y : {0.3, 0.0, -0.5, 0.9}) {
      EXPECT_TRUE(sees(metal, 0.0, {2.0 + depth, y, -0.2})) << depth;
      EXPECT_FALSE(sees(metal, 6.0, {2.0 + depth, y, -0.2})) << depth;
    }
  }
  EXPECT_FALSE(sees(metal, 0.0, {2.02, 0.3, 0.2}));
}

TEST(Mounting, ATagBehindAThinPlateIsNotSeenThroughIt) {
  for (const double thickness : {0.001, 0.004, 0.01}) {
    const RadioScene metal = radio_of({box({thickness, 2.0, 2.0}, {3.0, 0.0, 0.0})}, true);
    const double half = 0.5 * thickness;
    for (const double off : {-0.2 * thickness, -1e-12, 0.0, 1e-12, 0.001, 0.008}) {
      EXPECT_TRUE(sees(metal, 0.0, {3.0 - half - off, 0.2, -0.2})) << thickness << ' ' << off;
      EXPECT_FALSE(sees(metal, 0.0, {3.0 + half + off, 0.2, -0.2})) << thickness << ' ' << off;
      EXPECT_TRUE(sees(metal, 6.0, {3.0 + half + off, 0.2, -0.2})) << thickness << ' ' << off;
      EXPECT_FALSE(sees(metal, 6.0, {3.0 - half - off, 0.2, -0.2})) << thickness << ' ' << off;
    }
  }
}

TEST(Mounting, ASheetsFrontIsWhereItsNormalPoints) {
  const RadioScene metal = radio_of({sheet(2.0, false)}, true);
  EXPECT_TRUE(sees(metal, 0.0, {1.995, 0.1, 0.1}));
  EXPECT_FALSE(sees(metal, 4.0, {1.995, 0.1, 0.1}));
  EXPECT_TRUE(sees(metal, 0.0, {2.005, 0.1, 0.1}));
  EXPECT_FALSE(sees(metal, 0.0, {2.02, 0.1, 0.1}));
}

TEST(Mounting, AtASlantATagIsStillSeen) {
  const RadioScene metal = radio_of({box({20.0, 20.0, 2.0}, {0.0, 0.0, -1.0})}, true);
  for (const double degrees : {10.0, 45.0, 60.0, 75.0, 80.0}) {
    const double slant = degrees * 3.14159265358979 / 180.0;
    const Eigen::Vector3d antenna(4.0 * std::sin(slant), 0.1, 4.0 * std::cos(slant));
    EXPECT_TRUE(is_unobstructed(metal, antenna, {0.0, 0.0, -0.01})) << degrees;
    EXPECT_FALSE(is_unobstructed(metal, antenna, {0.0, 0.0, -0.016})) << degrees;
  }
}

TEST(Crossings, OfMirroredWaysSayWhichLeg) {
  const RadioScene radio =
      radio_of({{"floor", Plane{}, {}}, box({0.2, 4.0, 0.5}, {3.0, 0.0, 0.8})});
  TraceOptions options;
  options.order = 1;
  std::vector<RadioPath> paths;
  // The path is reflected by the floor at x = 2, so the box is on the second leg.
  trace_paths(radio, images_of(radio, {0.0, 0.0, 2.0}, options), {4.0, 0.0, 2.0}, options, paths);
  ASSERT_EQ(paths.size(), 2U);
  EXPECT_TRUE(paths[0].crossings.empty());
  ASSERT_EQ(paths[1].crossings.size(), 1U);
  const Crossing& crossing = paths[1].crossings[0];
  EXPECT_EQ(crossing.leg, 1);
  EXPECT_EQ(crossing.solid, 1U);
  // Entry at x = 2.9, z = 0.9; exit at the top, z = 1.05, at x = 3.05: before x = 3.1.
  EXPECT_NEAR(crossing.length_m, 0.15 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(crossing.cos_incidence, std::sqrt(0.5), 1e-12);
  EXPECT_TRUE(crossing.p_W.isApprox(Eigen::Vector3d(2.9, 0.0, 0.9), 1e-12));
}

TEST(Crossings, UnderABoxOnTheFloorTheWayGoesThroughTheBox) {
  Scene scene;
  scene.collisions = {{"floor", Plane{}, {}}, box({2.0, 2.0, 1.0}, {2.0, 0.0, 0.5})};
  TraceOptions options;
  options.order = 1;
  std::vector<RadioPath> paths;
  for (const bool metal : {false, true}) {
    RadioSceneOptions opaque;
    opaque.opaque = {1, static_cast<char>(metal)};
    const RadioScene radio(scene, opaque);
    trace_paths(radio, images_of(radio, {0.0, 0.0, 2.0}, options), {4.0, 0.0, 2.0}, options, paths);
    // Direct, via the top of the box and, if waves pass through it, via the floor beneath it.
    ASSERT_EQ(paths.size(), metal ? 2U : 3U);
    if (metal) continue;
    ASSERT_EQ(paths[1].bounces[0].solid, 0U);
    ASSERT_EQ(paths[1].crossings.size(), 2U);
    EXPECT_NEAR(paths[1].crossings[0].length_m, std::sqrt(2.0), 1e-9);
    EXPECT_NEAR(paths[1].crossings[1].length_m, std::sqrt(2.0), 1e-9);
  }
}

}  // namespace
}  // namespace tagfield
