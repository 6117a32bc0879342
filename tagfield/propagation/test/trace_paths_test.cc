// SPDX-License-Identifier: Apache-2.0
#include "tagfield/propagation/trace_paths.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "tagfield/base/test/error_text.h"

namespace tagfield {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<RadioPath> paths_between(const RadioScene& scene, const Eigen::Vector3d& p_WA,
                                     const Eigen::Vector3d& p_WT, const TraceOptions& options) {
  std::vector<RadioPath> paths;
  trace_paths(scene, images_of(scene, p_WA, options), p_WT, options, paths);
  return paths;
}

TraceOptions of_order(int order) {
  TraceOptions options;
  options.order = order;
  return options;
}

Scene floor_scene() {
  Scene scene;
  scene.collisions = {{"floor", Plane{}, {}}};
  return scene;
}

RadioSceneOptions all_opaque(const Scene& scene) {
  RadioSceneOptions options;
  options.opaque.assign(scene.collisions.size(), 1);
  return options;
}

RC_GTEST_PROP(TracePaths, OverAFloorTheMirrorPointDividesTheWayByTheHeights, ()) {
  const auto any = [](int low, int high) { return 1e-3 * *rc::gen::inRange(low, high); };
  const Eigen::Vector3d a(any(-9000, 9000), any(-9000, 9000), any(1, 5000));
  const Eigen::Vector3d t(any(-9000, 9000), any(-9000, 9000), any(1, 5000));
  RC_PRE(a != t);
  const auto paths = paths_between(RadioScene(floor_scene()), a, t, of_order(3));
  RC_ASSERT(paths.size() == 2U);
  RC_ASSERT(std::abs(paths[0].length_m - (t - a).norm()) < 1e-12);
  const double across = (t - a).head<2>().norm();
  RC_ASSERT(std::abs(paths[1].length_m - std::hypot(across, a.z() + t.z())) < 1e-9);
  const double part = a.z() / (a.z() + t.z());
  const Eigen::Vector2d expected = a.head<2>() + part * (t - a).head<2>();
  RC_ASSERT((paths[1].bounces[0].p_W.head<2>() - expected).norm() < 1e-9);
  RC_ASSERT(std::abs(paths[1].bounces[0].p_W.z()) < 1e-12);
  RC_ASSERT(paths[1].bounces[0].normal_W == Eigen::Vector3d::UnitZ());
  RC_ASSERT(paths[1].crossings.empty());
}

TEST(TracePaths, BetweenTwoMirrorsThereAreThoseOfEachOrder) {
  Scene scene = floor_scene();
  scene.collisions.push_back(
      {"ceiling", Plane{-Eigen::Vector3d::UnitZ(), {1.0, 1.0}}, from_translation({0.0, 0.0, 3.0})});
  const auto paths =
      paths_between(RadioScene(scene), {0.0, 0.0, 1.0}, {4.0, 0.0, 2.0}, of_order(3));
  // The images' heights: 1 | −1, 5 | 7, −5 | −7, 11, with the floor first or the ceiling first.
  const std::array<double, 7> heights{1.0, -1.0, 5.0, 7.0, -5.0, -7.0, 11.0};
  ASSERT_EQ(paths.size(), heights.size());
  for (std::size_t i = 0; i < heights.size(); ++i) {
    EXPECT_NEAR(paths[i].length_m, std::hypot(4.0, heights[i] - 2.0), 1e-12) << i;
  }
  EXPECT_EQ(paths[3].bounce_count, 2);
  EXPECT_EQ(paths[3].bounces[0].solid, 0U);
  EXPECT_EQ(paths[3].bounces[1].solid, 1U);
}

TEST(TracePaths, AnEmptySceneLeavesTheDirectWay) {
  const RadioScene scene{Scene{}};
  EXPECT_TRUE(scene.facets().empty());
  const auto paths = paths_between(scene, {0.0, 0.0, 0.0}, {3.0, 4.0, 0.0}, of_order(3));
  ASSERT_EQ(paths.size(), 1U);
  EXPECT_EQ(paths[0].bounce_count, 0);
  EXPECT_DOUBLE_EQ(paths[0].length_m, 5.0);
  EXPECT_TRUE(paths[0].departure_W.isApprox(Eigen::Vector3d(0.6, 0.8, 0.0)));
  EXPECT_TRUE(paths[0].arrival_W.isApprox(Eigen::Vector3d(0.6, 0.8, 0.0)));
  EXPECT_TRUE(is_unobstructed(scene, {0.0, 0.0, 0.0}, {3.0, 4.0, 0.0}));
}

TEST(TracePaths, EndsThatAreNotFiniteOrCoincideHaveNoPath) {
  const RadioScene scene(floor_scene());
  const Eigen::Vector3d good(1.0, 2.0, 3.0);
  for (const double bad : {kNan, kInf, -kInf}) {
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::Vector3d end = good;
      end[axis] = bad;
      EXPECT_TRUE(paths_between(scene, good, end, of_order(3)).empty());
      EXPECT_TRUE(paths_between(scene, end, good, of_order(3)).empty());
      EXPECT_TRUE(paths_between(scene, end, end, of_order(3)).empty());
      EXPECT_TRUE(straight_crossings(scene, end, good).empty());
      EXPECT_TRUE(is_unobstructed(scene, end, good));
    }
  }
  EXPECT_TRUE(paths_between(scene, good, good, of_order(3)).empty());
}

TEST(TracePaths, HugeCoordinatesGiveFinitePathsOrNone) {
  Scene scene = floor_scene();
  scene.collisions.push_back({"box", Box{{1.0, 1.0, 1.0}}, {}});
  const RadioScene radio(scene);
  for (const double far : {1e3, 1e6, 1e9}) {
    const auto paths = paths_between(radio, {far, 0.0, 1.0}, {-far, 0.0, 2.0}, of_order(3));
    EXPECT_EQ(paths.size(), 2U);
    for (const auto& path : paths) {
      const double up = path.bounce_count == 0 ? 1.0 : 3.0;
      EXPECT_NEAR(path.length_m / std::hypot(2.0 * far, up), 1.0, 1e-12);
      EXPECT_NEAR(path.departure_W.norm(), 1.0, 1e-12);
      EXPECT_NEAR(path.arrival_W.norm(), 1.0, 1e-12);
    }
  }
  for (const double far : {1.1e9, 1e12, 1e150, 1e300}) {
    EXPECT_TRUE(paths_between(radio, {far, 0.0, 1.0}, {0.0, 0.0, 2.0}, of_order(3)).empty());
    EXPECT_TRUE(paths_between(radio, {0.0, 0.0, 2.0}, {far, 0.0, 1.0}, of_order(3)).empty());
    EXPECT_TRUE(straight_crossings(radio, {0.0, 0.0, 2.0}, {far, 0.0, 1.0}).empty());
  }
}

TEST(TracePaths, OptionsOutOfRangeAreErrors) {
  const RadioScene scene(floor_scene());
  const auto message = [&](const TraceOptions& options) {
    return error_of([&] { images_of(scene, {0.0, 0.0, 1.0}, options); });
  };
  EXPECT_TRUE(contains(message(of_order(-1)), "order must be 0 to 3, is -1"));
  EXPECT_TRUE(contains(message(of_order(4)), "order must be 0 to 3, is 4"));
  TraceOptions options;
  options.max_length_m = kNan;
  EXPECT_TRUE(contains(message(options), "max_length_m"));
  options = {};
  options.mount_depth_m = -0.1;
  EXPECT_TRUE(contains(message(options), "mount_depth_m"));
  std::vector<RadioPath> paths;
  EXPECT_THROW(trace_paths(scene, {}, {0.0, 0.0, 1.0}, of_order(4), paths), Error);
  EXPECT_THROW(is_unobstructed(scene, {}, {0.0, 0.0, 1.0}, of_order(4)), Error);
  EXPECT_THROW(straight_crossings(scene, {}, {0.0, 0.0, 1.0}, of_order(4)), Error);
}

TEST(TracePaths, LongerPathsThanAskedAreLeftOut) {
  const RadioScene scene(floor_scene());
  TraceOptions options = of_order(1);
  options.max_length_m = 4.5;
  EXPECT_EQ(paths_between(scene, {0.0, 0.0, 1.0}, {4.0, 0.0, 2.0}, options).size(), 1U);
  options.max_length_m = 4.0;
  EXPECT_TRUE(paths_between(scene, {0.0, 0.0, 1.0}, {4.0, 0.0, 2.0}, options).empty());
  options.max_length_m = 5.1;
  EXPECT_EQ(paths_between(scene, {0.0, 0.0, 1.0}, {4.0, 0.0, 2.0}, options).size(), 2U);
}

TEST(TracePaths, ALowerOrderThanTheImagesIsTaken) {
  const RadioScene scene(floor_scene());
  const ImageSet images = images_of(scene, {0.0, 0.0, 1.0}, of_order(3));
  std::vector<RadioPath> paths(7);
  trace_paths(scene, images, {4.0, 0.0, 2.0}, of_order(0), paths);
  EXPECT_EQ(paths.size(), 1U);
  trace_paths(scene, images, {4.0, 0.0, 2.0}, of_order(1), paths);
  EXPECT_EQ(paths.size(), 2U);
}

TEST(TracePaths, AnEndInTheMirrorsPlaneOrBehindItHasNoBounce) {
  const RadioScene scene(floor_scene());
  EXPECT_EQ(paths_between(scene, {0.0, 0.0, 1.0}, {4.0, 0.0, 0.0}, of_order(2)).size(), 1U);
  EXPECT_EQ(paths_between(scene, {0.0, 0.0, 0.0}, {4.0, 0.0, 1.0}, of_order(2)).size(), 1U);
  EXPECT_EQ(paths_between(scene, {0.0, 0.0, 1.0}, {4.0, 0.0, 1e-3}, of_order(2)).size(), 2U);
  EXPECT_EQ(paths_between(scene, {0.0, 0.0, 1.0}, {4.0, 0.0, -1.0}, of_order(2)).size(), 1U);
}

TEST(TracePaths, ASheetMirrorsOnBothSidesAndABoxOutside) {
  auto sheet = std::make_shared<TriangleMesh>();
  sheet->vertices = {{-5.0, -5.0, 0.0}, {5.0, -5.0, 0.0}, {5.0, 5.0, 0.0}, {-5.0, 5.0, 0.0}};
  sheet->triangles = {{0, 1, 2}, {0, 2, 3}};
  Scene scene;
  scene.collisions = {{"sheet", MeshPtr(sheet), {}}};
  for (const double z : {1.0, -1.0}) {
    const auto paths = paths_between(RadioScene(scene), {0.0, 0.0, z}, {3.0, 0.0, z}, of_order(2));
    ASSERT_EQ(paths.size(), 2U);
    EXPECT_EQ(paths[1].bounces[0].normal_W.z(), z);
  }
  scene.collisions = {{"box", Box{{10.0, 10.0, 4.0}}, {}}};
  const auto inside =
      paths_between(RadioScene(scene), {0.0, 0.0, 1.0}, {3.0, 0.0, 1.0}, of_order(1));
  EXPECT_EQ(inside.size(), 7U);
  const auto outside =
      paths_between(RadioScene(scene), {0.0, 0.0, 3.0}, {3.0, 0.0, 3.0}, of_order(1));
  ASSERT_EQ(outside.size(), 2U);
  EXPECT_NEAR(outside[1].length_m, std::sqrt(13.0), 1e-12);
}

TEST(TracePaths, FlushFacetsGiveAPathOnceByTheOpaqueOrTheFirst) {
  Scene scene;
  const auto at = [](double x) { return from_translation({x, 0.0, -0.5}); };
  scene.collisions = {{"one", Box{{4.0, 4.0, 1.0}}, at(-1.0)},
                      {"two", Box{{4.0, 4.0, 1.0}}, at(1.0)}};
  RadioSceneOptions options;
  const Eigen::Vector3d a(0.5, 0.3, 1.0);
  const Eigen::Vector3d t(-0.4, 0.2, 1.5);
  for (const bool second : {false, true}) {
    options.opaque = {0, static_cast<char>(second)};
    const auto paths = paths_between(RadioScene(scene, options), a, t, of_order(1));
    ASSERT_EQ(paths.size(), 2U);
    EXPECT_EQ(paths[1].bounces[0].solid, second ? 1U : 0U);
    EXPECT_TRUE(paths[1].crossings.empty());
  }
}

TEST(TracePaths, BlockedPathsAreLeftOutOrMarked) {
  Scene scene = floor_scene();
  scene.collisions.push_back({"wall", Box{{0.2, 2.0, 0.5}}, from_translation({2.0, 0.0, 2.0})});
  const RadioScene radio(scene, all_opaque(scene));
  TraceOptions options = of_order(1);
  const Eigen::Vector3d a(0.0, 0.0, 2.0);
  const Eigen::Vector3d t(4.0, 0.0, 2.0);
  EXPECT_FALSE(is_unobstructed(radio, a, t));
  const auto free = paths_between(radio, a, t, options);
  ASSERT_EQ(free.size(), 1U);  // Via the floor.
  EXPECT_EQ(free[0].bounce_count, 1);
  EXPECT_FALSE(free[0].blocked);
  options.keep_blocked = true;
  const auto all = paths_between(radio, a, t, options);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_TRUE(all[0].blocked);
  ASSERT_EQ(all[0].crossings.size(), 1U);
  EXPECT_NEAR(all[0].crossings[0].length_m, 0.2, 1e-9);
  EXPECT_FALSE(all[1].blocked);
  options.occlusion = false;
  const auto through = paths_between(radio, a, t, options);
  ASSERT_EQ(through.size(), 2U);
  EXPECT_FALSE(through[0].blocked);
  EXPECT_TRUE(through[0].crossings.empty());
}

}  // namespace
}  // namespace tagfield
