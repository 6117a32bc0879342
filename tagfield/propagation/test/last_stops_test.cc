// SPDX-License-Identifier: Apache-2.0
// Tracing with LastStops against tracing without, bit by bit.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>

#include "tagfield/propagation/trace_paths.h"
#include "tagfield/sdf/load_world.h"

namespace tagfield {
namespace {

bool is_equal(const Crossing& one, const Crossing& other) {
  return one.solid == other.solid && one.leg == other.leg && one.length_m == other.length_m &&
         one.cos_incidence == other.cos_incidence && one.normal_W == other.normal_W &&
         one.p_W == other.p_W;
}

bool is_equal(const Bounce& one, const Bounce& other) {
  return one.solid == other.solid && one.facet == other.facet && one.p_W == other.p_W &&
         one.normal_W == other.normal_W;
}

bool is_equal(const RadioPath& one, const RadioPath& other) {
  const auto same = [](const auto& a, const auto& b) { return is_equal(a, b); };
  return one.bounce_count == other.bounce_count && one.length_m == other.length_m &&
         one.departure_W == other.departure_W && one.arrival_W == other.arrival_W &&
         one.blocked == other.blocked &&
         std::equal(one.bounces.begin(), one.bounces.begin() + one.bounce_count,
                    other.bounces.begin(), same) &&
         std::equal(one.crossings.begin(), one.crossings.end(), other.crossings.begin(),
                    other.crossings.end(), same);
}

struct Counts {
  std::size_t paths = 0;
  std::size_t stops = 0;
};

/// Traces the tag's paths with and without `last` and compares them.
void expect_same(const RadioScene& scene, const Eigen::Vector3d& p_WA, const Eigen::Vector3d& p_WT,
                 const TraceOptions& options, LastStops& last, Counts& counts) {
  const ImageSet images = images_of(scene, p_WA, options);
  std::vector<RadioPath> plain;
  std::vector<RadioPath> quick;
  trace_paths(scene, images, p_WT, options, plain);
  trace_paths(scene, images, p_WT, options, last, quick);
  ASSERT_TRUE(std::equal(plain.begin(), plain.end(), quick.begin(), quick.end(),
                         [](const auto& a, const auto& b) { return is_equal(a, b); }));
  counts.paths += plain.size();
  counts.stops += last.stops.size();
  EXPECT_LE(last.stops.size(), kMaxStops);
}

Eigen::Vector3d point_in(std::mt19937_64& random, double size) {
  std::uniform_real_distribution<double> within(-size, size);
  const double x = within(random);
  const double y = within(random);
  return {x, y, within(random)};
}

/// Boxes above a floor, most of them arbitrarily rotated, every other one opaque.
RadioScene random_scene(std::mt19937_64& random) {
  Scene scene;
  RadioSceneOptions options;
  const auto count = 3 + random() % 6;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d size = Eigen::Vector3d::Constant(0.3) + point_in(random, 2.0).cwiseAbs();
    const Eigen::Vector3d turn = i % 3 == 0 ? Eigen::Vector3d::Zero() : point_in(random, 3.0);
    scene.collisions.push_back({"box", Box{size}, from_xyz_rpy(point_in(random, 3.0), turn)});
    options.opaque.push_back(i % 2 == 0);
  }
  scene.collisions.push_back({"floor", Plane{}, from_translation({0.0, 0.0, -4.0})});
  options.opaque.push_back(1);
  return RadioScene(scene, options);
}

RC_GTEST_PROP(LastStops, ChangeNoPathAlongAnyWalk, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  const RadioScene scene = random_scene(random);
  TraceOptions options;
  options.order = *rc::gen::inRange(0, kMaxBounces + 1);
  options.keep_blocked = *rc::gen::inRange(0, 4) == 0;
  const double pace = *rc::gen::element(0.0, 0.02, 0.5);
  Eigen::Vector3d p_WA = point_in(random, 4.0);
  const Eigen::Vector3d p_WT = point_in(random, 4.0);
  LastStops last;
  Counts counts;
  for (int step = 0; step < 12; ++step) {
    expect_same(scene, p_WA, p_WT, options, last, counts);
    RC_ASSERT(!testing::Test::HasFatalFailure());
    p_WA += point_in(random, pace);
  }
}

RC_GTEST_PROP(LastStops, OfAnotherTagOrOfNoSenseDoNoHarm, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  const RadioScene scene = random_scene(random);
  TraceOptions options;
  options.order = 2;
  LastStops last;
  Counts counts;
  const Eigen::Vector3d p_WA = point_in(random, 4.0);
  for (int tag = 0; tag < 6; ++tag) {
    expect_same(scene, p_WA, point_in(random, 4.0), options, last, counts);
    RC_ASSERT(!testing::Test::HasFatalFailure());
    for (LastStops::Stop& stop : last.stops) {
      stop.collision = static_cast<std::uint32_t>(random() % scene.opaque().size());
      stop.triangle = static_cast<std::uint32_t>(random() % 1000);
    }
  }
}

TEST(LastStops, ChangeNoPathInTheSmallWarehouse) {
  Diagnostics diagnostics;
  const Scene world =
      load_world(TAGFIELD_SOURCE_DIR "/worlds/small_warehouse.sdf", {}, diagnostics);
  RadioSceneOptions scene_options;
  for (std::size_t i = 0; i < world.collisions.size(); ++i) {
    scene_options.opaque.push_back(i % 3 != 0);
  }
  const RadioScene scene(world, scene_options);
  std::mt19937_64 random(1);
  Counts counts;
  for (const int order : {1, 2, 3}) {
    TraceOptions options;
    options.order = order;
    for (int tag = 0; tag < 30; ++tag) {
      const Eigen::Vector3d p_WT = point_in(random, 1.0).cwiseProduct(Eigen::Vector3d(5, 5, 1)) +
                                   Eigen::Vector3d(0.0, 0.0, 1.3);
      LastStops last;
      for (int step = 0; step < 8; ++step) {
        expect_same(scene, {0.02 * step, 0.01 * tag, 1.5}, p_WT, options, last, counts);
        if (HasFatalFailure()) return;
      }
    }
  }
  EXPECT_GT(counts.paths, 3000U);
  EXPECT_GT(counts.stops, 3000U);
}

}  // namespace
}  // namespace tagfield
