// SPDX-License-Identifier: Apache-2.0
// Drives through the project's warehouse.

#include <gtest/gtest.h>

#include <cmath>

#include "tagfield/base/random.h"
#include "tagfield/navigation/global_planner.h"
#include "tagfield/navigation/keep_out.h"
#include "tagfield/navigation/test/test_worlds.h"
#include "tagfield/sdf/load_world.h"

namespace tagfield {
namespace {

using testing::DriveSimulation;
using testing::Edges;

/// Height range in which the robot could collide with something [m].
constexpr double kLow = 0.02;
constexpr double kHigh = 0.36;

struct Warehouse {
  Scene scene;
  RayScene rays;
  Edges edges;
  OccupancyGrid map;

  explicit Warehouse(Scene given)
      : scene(std::move(given)), rays(scene), edges(scene, kLow, kHigh) {
    // The racks' lowest boards are below the scan plane.
    map = with_keep_out(true_map(scene, 0.31, {3.0, 0.0}, 0.05),
                        top_view(scene, kLow, kHigh, 0.001), {});
  }
};

const Warehouse& warehouse() {
  static const Warehouse result = [] {
    Diagnostics diagnostics;
    return Warehouse(
        load_world(TAGFIELD_SOURCE_DIR "/worlds/small_warehouse.sdf", {}, diagnostics));
  }();
  return result;
}

/// A random goal that can be reached from `pose`.
PlanarPose random_goal(RandomStream& stream, const PlanarPose& pose) {
  const OccupancyGrid& map = warehouse().map;
  for (;;) {
    const PlanarPose goal{map.origin.x() + map.width * map.resolution_m * uniform(stream),
                          map.origin.y() + map.height * map.resolution_m * uniform(stream),
                          kTwoPi * uniform(stream)};
    if (plan(map, {}, pose, goal, {0.36, 0.05, 0.3}).refusal.empty()) return goal;
  }
}

/// An estimated pose that is off by 2 cm and 0.3° in varying directions.
std::function<PlanarPose(Time)> wandering(double phase) {
  return [phase](Time now) {
    const double t = to_seconds(now);
    return PlanarPose{0.02 * std::cos(0.2 * t + phase), 0.02 * std::sin(0.2 * t + phase),
                      radians(0.3) * std::sin(0.3 * t + 2.0 * phase)};
  };
}

class Drives : public ::testing::TestWithParam<int> {};

/// 100 goals in all, ten per case, each starting from the last; in every other case the robot's
/// pose estimate is off.
TEST_P(Drives, ReachTheirGoalsAndTouchNothing) {
  RandomStream stream(7, Purpose::kOdometry, static_cast<std::uint64_t>(GetParam()));
  PlanarPose pose{3.0, 0.0, 0.0};
  for (int i = 0; i < 10; ++i) {
    const PlanarPose goal = random_goal(stream, pose);
    GoalDriver driver({}, from_translation({0.15, 0.0, 0.31}));
    driver.set_map(warehouse().map);
    DriveSimulation simulation;
    simulation.world = &warehouse().rays;
    simulation.edges = &warehouse().edges;
    simulation.laser.beams = 361;  // A beam every half degree suffices and takes half the time.
    simulation.seed = static_cast<std::uint64_t>(10 * GetParam() + i);
    simulation.pose = pose;
    if (GetParam() % 2 == 1) simulation.belief_error = wandering(i);
    driver.set_goal(goal, simulation.believed(), simulation.now());
    simulation.run(driver, 300.0);
    EXPECT_EQ(driver.state(), DriveState::kReached) << driver.reason();
    EXPECT_LT(std::hypot(simulation.pose.x - goal.x, simulation.pose.y - goal.y), 0.1);
    EXPECT_LT(std::abs(wrap_to_pi(simulation.pose.yaw - goal.yaw)), 0.1);
    EXPECT_GT(simulation.min_distance_m, 0.0);
    pose = simulation.pose;
  }
}

INSTANTIATE_TEST_SUITE_P(Warehouse, Drives, ::testing::Range(0, 10));

}  // namespace
}  // namespace tagfield
