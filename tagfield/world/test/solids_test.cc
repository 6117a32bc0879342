// SPDX-License-Identifier: Apache-2.0
#include "tagfield/world/solids.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/world/test/mesh_volume.h"
#include "tagfield/world/triangulate.h"

namespace tagfield {
namespace {

/// The area vectors of a closed surface sum to zero.
void expect_closed(const TriangleMesh& mesh) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& [a, b, c] : mesh.triangles) {
    sum += (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
  }
  EXPECT_LT(sum.norm(), 1e-12);
}

Eigen::AlignedBox3d bounds_of(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& vertex : mesh.vertices) bounds.extend(vertex);
  return bounds;
}

/// Ratio of the areas of a regular polygon and its circumscribed circle.
const double kPolygon = kCircleEdges / kTwoPi * std::sin(kTwoPi / kCircleEdges);

TEST(Solids, ConeHoldsAThirdOfItsPrism) {
  const TriangleMesh cone = cone_mesh(2.0, 3.0);
  expect_closed(cone);
  EXPECT_NEAR(volume(cone), kPolygon * kPi * 4.0, 1e-9);
  EXPECT_EQ(bounds_of(cone).min().z(), -1.5);
  EXPECT_EQ(bounds_of(cone).max().z(), 1.5);
}

TEST(Solids, CapsuleIsACylinderAndABall) {
  const TriangleMesh capsule = capsule_mesh(0.5, 2.0);
  expect_closed(capsule);
  const double ball = volume(triangulate(Sphere{0.5}));
  EXPECT_NEAR(volume(capsule), ball + kPolygon * kPi * 0.25 * 2.0, 1e-12);
  EXPECT_TRUE(bounds_of(capsule).max().isApprox(Eigen::Vector3d(0.5, 0.5, 1.5)));
}

TEST(Solids, EllipsoidIsAStretchedBall) {
  const TriangleMesh ellipsoid = ellipsoid_mesh({1.0, 2.0, 3.0});
  expect_closed(ellipsoid);
  EXPECT_NEAR(volume(ellipsoid), 6.0 * volume(triangulate(Sphere{1.0})), 1e-12);
  for (const Eigen::Vector3d& p : ellipsoid.vertices) {
    EXPECT_NEAR(p.cwiseQuotient(Eigen::Vector3d(1.0, 2.0, 3.0)).norm(), 1.0, 1e-12);
  }
}

const Outline kSquare = {{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}, {0.0, 4.0}};

TEST(Solids, PrismsOfEitherSenseAndWithTheFirstCornerAgain) {
  const Outline ell = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}};
  Outline reversed(ell.rbegin(), ell.rend());
  Outline closed = ell;
  closed.push_back(ell.front());
  for (const Outline& outline : {ell, reversed, closed}) {
    const TriangleMesh prism = prism_mesh({outline}, 2.0);
    expect_closed(prism);
    EXPECT_NEAR(volume(prism), 2.0 * 4.0, 1e-12);
    EXPECT_EQ(bounds_of(prism).min(), Eigen::Vector3d(0, 0, 0));
    EXPECT_EQ(bounds_of(prism).max(), Eigen::Vector3d(3, 2, 2));
  }
}

TEST(Solids, OutlinesInOutlinesAreHolesAndIslands) {
  const Outline hole = {{1.0, 1.0}, {3.0, 1.0}, {3.0, 3.0}, {1.0, 3.0}};
  const Outline island = {{1.5, 1.5}, {2.5, 1.75}, {2.0, 2.5}};
  const double island_area = 0.5 * (1.0 * 1.0 - 0.25 * 0.5);
  expect_closed(prism_mesh({kSquare, hole}, 1.0));
  EXPECT_NEAR(volume(prism_mesh({kSquare, hole}, 1.0)), 16.0 - 4.0, 1e-12);
  const TriangleMesh all = prism_mesh({island, kSquare, hole}, 1.0);
  expect_closed(all);
  EXPECT_NEAR(volume(all), 12.0 + island_area, 1e-12);
}

TEST(Solids, NothingIsAPrismOverNothing) {
  EXPECT_TRUE(prism_mesh({}, 1.0).triangles.empty());
  EXPECT_TRUE(prism_mesh({{{0, 0}, {1, 1}}}, 1.0).triangles.empty());
}

}  // namespace
}  // namespace tagfield
