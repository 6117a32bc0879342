// SPDX-License-Identifier: Apache-2.0
#include "tagfield/map/top_view.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/world/triangulate.h"

namespace tagfield {
namespace {

double signed_area(const Polygon& ring) {
  double sum = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d& a = ring[i];
    const Eigen::Vector2d& b = ring[(i + 1) % ring.size()];
    sum += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return sum;
}

/// Whether the even-odd rule fills (x, y): a ray to the right crosses an odd number of edges.
bool is_filled(const Silhouette& silhouette, double x, double y) {
  bool filled = false;
  for (const Polygon& ring : silhouette.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d& a = ring[i];
      const Eigen::Vector2d& b = ring[(i + 1) % ring.size()];
      if ((a.y() > y) == (b.y() > y)) continue;
      if (x < a.x() + (y - a.y()) * (b.x() - a.x()) / (b.y() - a.y())) filled = !filled;
    }
  }
  return filled;
}

/// Area filled by the even-odd rule if no rings cross: a ring within another is a hole.
double filled_area(const Silhouette& silhouette) {
  double sum = 0.0;
  for (const Polygon& ring : silhouette.rings) sum += signed_area(ring);
  return std::abs(sum);
}

Scene seen_scene(const Shape& shape, const RigidTransform& X_WC = {}) {
  Scene scene;
  scene.collisions.push_back({"thing", shape, X_WC});
  return scene;
}

Silhouette only(const std::vector<Silhouette>& silhouettes) {
  EXPECT_EQ(silhouettes.size(), 1U);
  return silhouettes.empty() ? Silhouette{} : silhouettes.front();
}

MeshPtr mesh_of(TriangleMesh mesh) { return std::make_shared<const TriangleMesh>(std::move(mesh)); }

TEST(TopView, BoxIsItsFootprintWithMargin) {
  const Scene scene = seen_scene(Box{{2.0, 1.0, 1.0}}, from_translation({5.0, -3.0, 0.5}));
  const Silhouette view = only(top_view(scene, -1.0, 2.0, 0.01));
  EXPECT_EQ(view.name, "thing");
  EXPECT_EQ(view.rings.size(), 1U);
  EXPECT_NEAR(filled_area(view), 2.02 * 1.02, 1e-6);
  EXPECT_DOUBLE_EQ(view.z_min, 0.0);
  EXPECT_DOUBLE_EQ(view.z_max, 1.0);
}

TEST(TopView, RotatedBoxKeepsItsArea) {
  const Scene scene = seen_scene(Box{{3.0, 1.0, 1.0}}, from_planar(2.0, 1.0, radians(30.0)));
  const Silhouette view = only(top_view(scene, -1.0, 1.0, 0.0));
  EXPECT_NEAR(filled_area(view), 3.0, 1e-3);
  EXPECT_TRUE(is_filled(view, 2.0 + 1.2 * std::cos(radians(30.0)), 1.0 + 1.2 * 0.5));
  EXPECT_FALSE(is_filled(view, 3.2, 1.0));
}

TEST(TopView, OverlappingTrianglesCountOnce) {
  // Two right triangles of area 2 that overlap in the triangle (0,0) (2,0) (1,1), of area 1.
  const TriangleMesh mesh = {{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 1}, {0, 0, 1}, {2, 0, 1}},
                             {{0, 1, 2}, {3, 4, 5}}};
  const Silhouette view = only(top_view(seen_scene(mesh_of(mesh)), -1.0, 2.0, 0.0));
  EXPECT_NEAR(filled_area(view), 3.0, 1e-6);
}

TEST(TopView, WallTallerThanTheBandStillShows) {
  const Scene scene = seen_scene(Box{{4.0, 0.2, 4.0}}, from_translation({0.0, 0.0, 2.0}));
  const Silhouette view = only(top_view(scene, 0.1, 1.5, 0.01));
  // Top and bottom are cut off: four sides remain, each 2 cm thick around the footprint.
  EXPECT_NEAR(filled_area(view), 4.02 * 0.22 - 3.98 * 0.18, 1e-5);
  EXPECT_EQ(view.rings.size(), 2U);
  EXPECT_DOUBLE_EQ(view.z_min, 0.1);
  EXPECT_DOUBLE_EQ(view.z_max, 1.5);
}

TEST(TopView, BandCutsSlopes) {
  // A ramp that rises by 1 m over 1 m: the band contains the part between its two heights.
  const TriangleMesh mesh = {{{0, 0, 0}, {1, 0, 1}, {1, 2, 1}, {0, 2, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const Silhouette view = only(top_view(seen_scene(mesh_of(mesh)), 0.25, 0.75, 0.0));
  EXPECT_NEAR(filled_area(view), 0.5 * 2.0, 1e-6);
}

TEST(TopView, HoleIsARing) {
  // A square frame of 4 × 4 with a hole of 2 × 2, as eight triangles.
  TriangleMesh mesh;
  for (const double half : {2.0, 1.0}) {
    mesh.vertices.insert(mesh.vertices.end(),
                         {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}});
  }
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t next = (i + 1) % 4;
    mesh.triangles.push_back({i, next, 4 + next});
    mesh.triangles.push_back({i, 4 + next, 4 + i});
  }
  const Silhouette view = only(top_view(seen_scene(mesh_of(mesh)), -1.0, 1.0, 0.0));
  EXPECT_EQ(view.rings.size(), 2U);
  EXPECT_NEAR(filled_area(view), 12.0, 1e-6);
  EXPECT_TRUE(is_filled(view, 1.5, 0.0));
  EXPECT_FALSE(is_filled(view, 0.3, 0.2));
}

TEST(TopView, PlanesAndWhatLiesOutsideTheBandAreLeftOut) {
  Scene scene = seen_scene(Plane{});
  scene.collisions.push_back({"lamp", Sphere{0.2}, from_translation({0.0, 0.0, 5.0})});
  scene.collisions.push_back({"pit", Sphere{0.2}, from_translation({0.0, 0.0, -5.0})});
  EXPECT_TRUE(top_view(scene, 0.0, 2.0).empty());
}

TEST(TopView, HigherThingsComeLater) {
  Scene scene;
  for (const auto& [name, height] : {std::pair("high", 1.5), {"low", 0.2}, {"middle", 0.7}}) {
    scene.collisions.push_back({name, Box{{1.0, 1.0, height}}, {}});
  }
  const auto views = top_view(scene, 0.0, 2.0);
  ASSERT_EQ(views.size(), 3U);
  EXPECT_EQ(views[0].name, "low");
  EXPECT_EQ(views[1].name, "middle");
  EXPECT_EQ(views[2].name, "high");
}

TEST(TopView, SphereIsItsPolygon) {
  const Silhouette view = only(top_view(seen_scene(Sphere{1.0}), -2.0, 2.0, 0.0));
  const double expected = 0.5 * kCircleEdges * std::sin(kTwoPi / kCircleEdges);
  EXPECT_NEAR(filled_area(view), expected, 1e-3);
}

TEST(TopView, ThingsFarBeyondAnyWorldAreAnError) {
  const Scene scene = seen_scene(Sphere{1.0}, from_translation({1e12, 0.0, 0.0}));
  EXPECT_THROW(top_view(scene, -2.0, 2.0), Error);
}

/// Whether (x, y) lies in the triangle, by the signs of three cross products.
bool in_triangle(const std::array<Eigen::Vector2d, 3>& t, double x, double y) {
  const auto side = [x, y](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
  };
  const double s0 = side(t[0], t[1]);
  const double s1 = side(t[1], t[2]);
  const double s2 = side(t[2], t[0]);
  return (s0 > 0 && s1 > 0 && s2 > 0) || (s0 < 0 && s1 < 0 && s2 < 0);
}

Eigen::Vector2d grid_point() { return {*rc::gen::inRange(0, 20), *rc::gen::inRange(0, 20)}; }

RC_GTEST_PROP(TopView, FillsWhatAnyTriangleCovers, ()) {
  TriangleMesh mesh;
  std::vector<std::array<Eigen::Vector2d, 3>> triangles;
  for (std::uint32_t i = 0; i < 40; ++i) {
    triangles.push_back({grid_point(), grid_point(), grid_point()});
    for (const Eigen::Vector2d& p : triangles.back()) mesh.vertices.emplace_back(p.x(), p.y(), 0.1);
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const auto views = top_view(seen_scene(mesh_of(mesh)), 0.0, 1.0, 0.0);
  const Silhouette view = views.empty() ? Silhouette{} : views.front();
  // Probes on a grid, slightly off all relevant lines between grid points.
  for (double x = 0.3137; x < 20.0; x += 1.0) {
    for (double y = 0.2718; y < 20.0; y += 1.0) {
      bool covered = false;
      for (const auto& triangle : triangles) covered = covered || in_triangle(triangle, x, y);
      RC_ASSERT(is_filled(view, x, y) == covered);
    }
  }
}

TEST(TopViewJson, RoundTripKeepsEveryNumber) {
  Scene scene = seen_scene(Sphere{1.0}, from_translation({0.1, 1.0 / 3.0, 0.0}));
  scene.collisions.push_back({"wall \"north\"\n", Box{{4.0, 0.2, 4.0}}, {}});
  const auto views = top_view(scene, -0.5, 1.5);
  const auto again = top_view_from_json(top_view_to_json(views));
  ASSERT_EQ(again.size(), views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_EQ(again[i].name, views[i].name);
    EXPECT_EQ(again[i].z_min, views[i].z_min);
    EXPECT_EQ(again[i].z_max, views[i].z_max);
    EXPECT_EQ(again[i].rings, views[i].rings);
  }
}

TEST(TopViewJson, FormIsAsDocumented) {
  const Silhouette silhouette{"a", 0.0, 1.5, {{{0.0, 0.0}, {1.0, 0.0}, {0.0, 2.0}}}};
  EXPECT_EQ(top_view_to_json({silhouette}),
            R"([{"name":"a","rings":[[[0.0,0.0],[1.0,0.0],[0.0,2.0]]],"z_max":1.5,"z_min":0.0}])");
  EXPECT_EQ(top_view_to_json({}), "[]");
}

TEST(TopViewJson, AnythingElseIsAnError) {
  for (const char* text : {"", "{", "{}", "3", "[1]", R"([{"name": "a"}])",
                           R"([{"name": 1, "z_min": 0, "z_max": 1, "rings": []}])",
                           R"([{"name": "a", "z_min": "0", "z_max": 1, "rings": []}])",
                           R"([{"name": "a", "z_min": 0, "z_max": 1, "rings": [[[0]]]}])",
                           R"([{"name": "a", "z_min": 0, "z_max": 1, "rings": [[[0, "x"]]]}])",
                           R"([{"name": "a", "z_min": 0, "z_max": 1, "rings": [[[0, 1, 2]]]}])",
                           R"([{"name": "a", "z_min": 0, "z_max": 1e999, "rings": []}])"}) {
    EXPECT_THROW(top_view_from_json(text), Error) << text;
  }
  const std::string deep(500'000, '[');
  EXPECT_THROW(top_view_from_json(deep), Error);
  EXPECT_THROW(top_view_from_json(deep + std::string(deep.size(), ']')), Error);
}

TEST(TopViewJson, NamesThatAreNotUtf8AreWritten) {
  EXPECT_NO_THROW(top_view_to_json({{"\xff", 0.0, 1.0, {}}}));
}

}  // namespace
}  // namespace tagfield
