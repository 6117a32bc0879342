// SPDX-License-Identifier: Apache-2.0
#include "tagfield/propagation/radio_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tagfield/base/test/error_text.h"
#include "tagfield/base/units.h"
#include "tagfield/propagation/trace_paths.h"
#include "tagfield/world/triangulate.h"

namespace tagfield {
namespace {

Scene scene_of(const Shape& shape, const RigidTransform& X_WC = {}) {
  Scene scene;
  scene.collisions = {{"solid", shape, X_WC}};
  return scene;
}

TEST(RadioScene, ABoxHasSixFacetsThatFaceOut) {
  const RigidTransform X_WC = from_xyz_rpy({1.0, 2.0, 3.0}, {0.3, -0.4, 0.5});
  const RadioScene radio(scene_of(Box{{1.0, 2.0, 3.0}}, X_WC));
  ASSERT_EQ(radio.facets().size(), 6U);
  double area = 0.0;
  for (const Facet& facet : radio.facets()) {
    EXPECT_FALSE(facet.two_sided);
    EXPECT_TRUE(facet.rectangular);
    EXPECT_NEAR(facet.size_m.prod(), facet.area_m2, 1e-12);
    EXPECT_LT(facet.normal_W.dot(X_WC.translation), facet.offset_m);
    EXPECT_EQ(facet.triangles.size(), 2U);
    area += facet.area_m2;
  }
  EXPECT_NEAR(area, 22.0, 1e-12);
  EXPECT_EQ(radio.left_out().count, 0U);
}

TEST(RadioScene, SmallPiecesAreLeftOutAndCounted) {
  RadioSceneOptions options;
  options.min_facet_m2 = 2.5;
  const RadioScene radio(scene_of(Box{{1.0, 2.0, 3.0}}), options);
  EXPECT_EQ(radio.facets().size(), 4U);
  EXPECT_EQ(radio.left_out().count, 2U);
  EXPECT_NEAR(radio.left_out().area_m2, 4.0, 1e-12);
}

TEST(RadioScene, CurvedSidesDontMirrorAndCapsDo) {
  EXPECT_TRUE(RadioScene(scene_of(Sphere{5.0})).facets().empty());
  const RadioScene radio(scene_of(Cylinder{3.0, 8.0}));
  ASSERT_EQ(radio.facets().size(), 2U);
  const double area = 0.5 * kCircleEdges * 9.0 * std::sin(kTwoPi / kCircleEdges);
  for (const Facet& facet : radio.facets()) {
    EXPECT_NEAR(std::abs(facet.normal_W.z()), 1.0, 1e-12);
    EXPECT_NEAR(facet.area_m2, area, 1e-9);
    EXPECT_FALSE(facet.rectangular);
    EXPECT_FALSE(facet.two_sided);
  }
  EXPECT_EQ(radio.left_out().count, 0U);
}

TEST(RadioScene, APlaneIsEndless) {
  const RadioScene radio(scene_of(Plane{{0.0, 0.0, 2.0}, {1.0, 1.0}}, from_translation({0, 0, 3})));
  ASSERT_EQ(radio.facets().size(), 1U);
  EXPECT_TRUE(radio.facets()[0].unbounded);
  EXPECT_DOUBLE_EQ(radio.facets()[0].offset_m, 3.0);
  EXPECT_TRUE(std::isinf(radio.facets()[0].area_m2));
}

/// A box as exporters write it: each triangle with its own three vertices.
MeshPtr soup(const Eigen::Vector3d& size, bool inside_out) {
  const TriangleMesh box = triangulate(Box{size});
  auto mesh = std::make_shared<TriangleMesh>();
  for (const auto& [a, b, c] : box.triangles) {
    const auto first = static_cast<std::uint32_t>(mesh->vertices.size());
    for (const std::uint32_t i : {a, b, c}) mesh->vertices.push_back(box.vertices[i]);
    mesh->triangles.push_back({first, first + (inside_out ? 2 : 1), first + (inside_out ? 1 : 2)});
  }
  return mesh;
}

TEST(RadioScene, AMeshOfSingleTrianglesIsABoxWhicheverWayItIsTurned) {
  for (const bool inside_out : {false, true}) {
    const RadioScene radio(scene_of(soup({1.0, 2.0, 3.0}, inside_out)));
    ASSERT_EQ(radio.facets().size(), 6U);
    for (const Facet& facet : radio.facets()) {
      EXPECT_FALSE(facet.two_sided);
      EXPECT_GT(facet.offset_m, 0.0);
      EXPECT_TRUE(radio.shells()[facet.shell].closed);
      EXPECT_EQ(radio.shells()[facet.shell].inverted, inside_out);
    }
  }
}

TEST(RadioScene, ABoxWithoutALidIsOpen) {
  auto mesh = std::make_shared<TriangleMesh>(triangulate(Box{{1.0, 2.0, 3.0}}));
  mesh->triangles.resize(10);
  const RadioScene radio(scene_of(MeshPtr(mesh)));
  ASSERT_EQ(radio.facets().size(), 5U);
  for (const Facet& facet : radio.facets()) EXPECT_TRUE(facet.two_sided);
}

TEST(RadioScene, ASheetWithTwoFacesIsOneFacet) {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->vertices = {{0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {2.0, 1.0, 0.0}, {0.0, 1.0, 0.0}};
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}, {0, 2, 1}, {0, 3, 2}};
  const RadioScene radio(scene_of(MeshPtr(mesh)));
  ASSERT_EQ(radio.facets().size(), 1U);
  EXPECT_TRUE(radio.facets()[0].two_sided);
  EXPECT_NEAR(radio.facets()[0].area_m2, 2.0, 1e-12);
}

TEST(RadioScene, BadOptionsAreErrors) {
  RadioSceneOptions options;
  options.opaque = {1, 0};
  EXPECT_TRUE(contains(error_of([&] { RadioScene(scene_of(Sphere{1.0}), options); }), "opaque"));
  options.opaque = {};
  options.min_facet_m2 = std::nan("");
  EXPECT_TRUE(
      contains(error_of([&] { RadioScene(scene_of(Sphere{1.0}), options); }), "min_facet_m2"));
}

TEST(RadioScene, KnowsOnWhichSideAFacetHasPoints) {
  Scene scene = scene_of(Box{{1.0, 1.0, 1.0}});
  scene.collisions.push_back({"ground", Plane{}, from_translation({0.0, 0.0, -0.5})});
  const RadioScene radio(scene);
  const std::size_t ground = 6;
  ASSERT_TRUE(radio.facets()[ground].unbounded);
  for (std::size_t i = 0; i < 6; ++i) {
    const double z = radio.facets()[i].normal_W.z();
    EXPECT_EQ(radio.reaches(ground, true, i), z > -0.5) << i;  // All but the underside.
    EXPECT_FALSE(radio.reaches(ground, false, i));
    EXPECT_EQ(radio.reaches(i, true, ground), std::abs(z) < 0.5) << i;
    EXPECT_EQ(radio.reaches(i, false, ground), z > -0.5) << i;
  }
}

/// Also where the test line passes through an edge that two triangles share.
TEST(ShellsAround, AreThoseOfTheBoxesThatAPlaceIsIn) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Scene scene;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d size(1.0 + unit(random), 1.5 + unit(random), 2.0 + unit(random));
    scene.collisions.push_back({"box", Box{size.array() + 0.1},
                                from_xyz_rpy({8.0 * unit(random), unit(random), 0.0},
                                             {0.0, unit(random), 3.0 * unit(random)})});
  }
  const RadioScene radio(scene);
  int inside = 0;
  for (int i = 0; i < 100000; ++i) {
    const auto& box = scene.collisions[static_cast<std::size_t>(i) % 8];
    const Eigen::Vector3d half = 0.5 * std::get<Box>(box.shape).size;
    const Eigen::Vector3d p_C(unit(random) * half.x(), unit(random) * half.y(),
                              1.5 * unit(random) * half.z());
    const std::vector<char> around = shells_around(radio, box.X_WC * p_C);
    for (std::size_t shell = 0; shell < around.size(); ++shell) {
      if (radio.shells()[shell].solid != static_cast<std::uint32_t>(i % 8)) continue;
      if (!radio.shells()[shell].closed) continue;
      ASSERT_EQ(around[shell] != 0, std::abs(p_C.z()) < half.z()) << i;
      inside += around[shell];
    }
  }
  EXPECT_GT(inside, 50000);
}

}  // namespace
}  // namespace tagfield
