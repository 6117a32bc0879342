// SPDX-License-Identifier: Apache-2.0
#include "tagfield/map/internal/cross_section.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "tagfield/base/units.h"
#include "tagfield/world/triangulate.h"

namespace tagfield {
namespace {

const Square kEverything{{0.0, 0.0}, 1000.0};

Scene scene_of(const Shape& shape, const RigidTransform& X_WC = {}) {
  Scene scene;
  scene.collisions = {{"model::link::collision", shape, X_WC}};
  return scene;
}

double total_length(const std::vector<Segment>& segments) {
  double sum = 0.0;
  for (const Segment& segment : segments) sum += (segment.to - segment.from).norm();
  return sum;
}

/// Whether each end is, bit by bit, the end of two segments.
bool is_closed(const std::vector<Segment>& segments) {
  std::map<std::pair<double, double>, int> ends;
  for (const Segment& segment : segments) {
    ++ends[{segment.from.x(), segment.from.y()}];
    ++ends[{segment.to.x(), segment.to.y()}];
  }
  for (const auto& [end, count] : ends) {
    if (count % 2 != 0) return false;
  }
  return !ends.empty();
}

TEST(CrossSection, OfABoxIsItsRectangle) {
  const auto segments = cross_section(
      scene_of(Box{{4.0, 2.0, 1.0}}, from_translation({10.0, 0.0, 0.5})), 0.3, kEverything);
  EXPECT_TRUE(is_closed(segments));
  EXPECT_NEAR(total_length(segments), 12.0, 1e-12);
  for (const Segment& segment : segments) {
    for (const Eigen::Vector2d& p : {segment.from, segment.to}) {
      const Eigen::Vector2d from_centre = (p - Eigen::Vector2d(10.0, 0.0)).cwiseAbs();
      EXPECT_NEAR(std::max(from_centre.x() / 2.0, from_centre.y()), 1.0, 1e-12);
    }
  }
}

TEST(CrossSection, AboveAndBelowASolidIsNothing) {
  const Scene box = scene_of(Box{{4.0, 2.0, 1.0}});
  EXPECT_TRUE(cross_section(box, 0.51, kEverything).empty());
  EXPECT_TRUE(cross_section(box, -0.51, kEverything).empty());
  EXPECT_TRUE(cross_section(Scene{}, 0.0, kEverything).empty());
}

TEST(CrossSection, ASolidIsCutAtItsTopAndNotAtItsUnderside) {
  const Scene box = scene_of(Box{{4.0, 2.0, 1.0}});
  EXPECT_TRUE(cross_section(box, -0.5, kEverything).empty());
  const auto segments = cross_section(box, 0.5, kEverything);
  EXPECT_TRUE(is_closed(segments));
  EXPECT_NEAR(total_length(segments), 12.0, 1e-12);
}

TEST(CrossSection, OfASphereIsThePolygonOfItsTriangles) {
  const auto segments = cross_section(scene_of(Sphere{2.0}), 0.0, kEverything);
  EXPECT_TRUE(is_closed(segments));
  const double polygon = 2.0 * kCircleEdges * 2.0 * std::sin(kPi / kCircleEdges);
  EXPECT_NEAR(total_length(segments), polygon, 1e-9);
}

RC_GTEST_PROP(CrossSection, OfATurnedSolidIsClosedAndOnItsSurface, ()) {
  const auto any = [](double most) { return most * 1e-4 * *rc::gen::inRange(-10000, 10000); };
  const RigidTransform X_WC =
      from_xyz_rpy({any(5.0), any(5.0), 0.0}, {any(3.0), any(3.0), any(3.0)});
  const Box box{{1.0 + std::abs(any(3.0)), 1.0 + std::abs(any(3.0)), 1.0 + std::abs(any(3.0))}};
  const double z = any(0.45);  // Half of the shortest edge is 0.5 m: the solid is always cut.
  const auto segments = cross_section(scene_of(box, X_WC), z, kEverything);
  RC_ASSERT(is_closed(segments));
  for (const Segment& segment : segments) {
    for (const double share : {0.0, 0.3, 1.0}) {
      const Eigen::Vector2d p = segment.from + share * (segment.to - segment.from);
      const Eigen::Vector3d p_C = X_WC.inverse() * Eigen::Vector3d(p.x(), p.y(), z);
      const Eigen::Vector3d to_face = 0.5 * box.size - p_C.cwiseAbs();
      RC_ASSERT(std::abs(to_face.minCoeff()) < 1e-9);
    }
  }
}

TEST(CrossSection, ALevelFloorIsNotCut) {
  EXPECT_TRUE(cross_section(scene_of(Plane{}), 0.0, kEverything).empty());
  EXPECT_TRUE(cross_section(scene_of(Plane{}), 0.3, kEverything).empty());
  EXPECT_TRUE(cross_section(scene_of(Plane{-Eigen::Vector3d::UnitZ()}), 0.3, kEverything).empty());
}

TEST(CrossSection, AnUprightPlaneIsALineThroughTheWholeSquare) {
  const Scene scene =
      scene_of(Plane{Eigen::Vector3d::UnitX()}, from_translation({3.0, 100.0, 7.0}));
  const auto segments = cross_section(scene, 0.3, {{1.0, 2.0}, 5.0});
  ASSERT_EQ(segments.size(), 1U);
  EXPECT_NEAR(segments[0].from.x(), 3.0, 1e-12);
  EXPECT_NEAR(segments[0].to.x(), 3.0, 1e-12);
  EXPECT_NEAR(std::min(segments[0].from.y(), segments[0].to.y()), -3.0, 1e-12);
  EXPECT_NEAR(std::max(segments[0].from.y(), segments[0].to.y()), 7.0, 1e-12);
  EXPECT_TRUE(cross_section(scene, 0.3, {{-4.0, 2.0}, 5.0}).empty());
}

TEST(CrossSection, ARampIsMetWhereItReachesTheHeight) {
  // Slope of 0.1 along x, so it is 0.3 m high at x = 3.
  const Plane ramp{Eigen::Vector3d(-0.1, 0.0, 1.0)};
  const auto segments = cross_section(scene_of(ramp), 0.3, {{0.0, 0.0}, 5.0});
  ASSERT_EQ(segments.size(), 1U);
  EXPECT_NEAR(segments[0].from.x(), 3.0, 1e-12);
  EXPECT_NEAR(total_length(segments), 10.0, 1e-12);
}

TEST(CrossSection, ReachesNoFurtherThanTheSquare) {
  const Scene box = scene_of(Box{{20.0, 20.0, 1.0}}, from_translation({10.0, 10.0, 0.0}));
  const auto segments = cross_section(box, 0.0, {{0.0, 0.0}, 5.0});
  // Two of the four sides extend 5 m into the square.
  EXPECT_NEAR(total_length(segments), 10.0, 1e-12);
  for (const Segment& segment : segments) {
    EXPECT_LE(segment.from.cwiseAbs().maxCoeff(), 5.0);
    EXPECT_LE(segment.to.cwiseAbs().maxCoeff(), 5.0);
  }
}

}  // namespace
}  // namespace tagfield
