// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/internal/self_driving.h"

#include <memory>
#include <utility>

#include "tagfield/base/random.h"
#include "tagfield/simulator/self_driver.h"

namespace tagfield {
namespace {

/// What a random pose is drawn for.
enum class PositionDraw : std::uint64_t { kStart, kGoal, kKidnapped };

/// Uncertainty of a robot's pose after it was placed by hand.
constexpr double kPlacedSigma_m = 0.02;
constexpr double kPlacedSigma_rad = 0.01;

/// A random pose for this robot and seed; `what` and `number` identify the draw.
PlanarPose drawn_position(const NavigationWorld& world, const RobotSpec& robot, std::uint64_t seed,
                          PositionDraw what, std::uint64_t number) {
  RandomStream stream(seed, Purpose::kPlaces, stream_key(robot.name),
                      static_cast<std::uint64_t>(what), number);
  return random_position(world.floor, stream);
}

std::vector<PlanarPose> goals_of(const NavigationWorld& world, const RobotSpec& robot,
                                 std::uint64_t seed) {
  if (!robot.waypoints.empty()) return goals_at(robot.start, robot.waypoints);
  std::vector<PlanarPose> goals = robot.goals_W;
  for (int i = 0; i < robot.random_goals; ++i) {
    goals.push_back(
        drawn_position(world, robot, seed, PositionDraw::kGoal, static_cast<std::uint64_t>(i)));
  }
  return goals;
}

}  // namespace

PoseEstimate placed_at(const PlanarPose& pose) {
  return {pose, Eigen::Vector3d(kPlacedSigma_m * kPlacedSigma_m, kPlacedSigma_m * kPlacedSigma_m,
                                kPlacedSigma_rad * kPlacedSigma_rad)
                    .asDiagonal()};
}

Robot self_driving_robot(const Scenario& scenario, RobotSpec robot, const SelfDriving& driving,
                         bool has_mapped, std::uint64_t seed) {
  const NavigationWorld& world = *driving.world;
  const std::vector<PlanarPose> goals = goals_of(world, robot, seed);
  std::optional<PoseEstimate> start = has_mapped ? driving.start : placed_at(robot.start);
  if (has_mapped) robot.start = driving.true_start;
  if (navigation_of(scenario).start != StartBelief::kKnown) start.reset();
  if (navigation_of(scenario).start == StartBelief::kRandom) {
    robot.start = drawn_position(world, robot, seed, PositionDraw::kStart, 0);
  }
  for (std::size_t i = 0; i < robot.kidnapped.size(); ++i) {
    std::optional<PlanarPose>& to_W = robot.kidnapped[i].to_W;
    if (!to_W) to_W = drawn_position(world, robot, seed, PositionDraw::kKidnapped, i);
  }
  auto driver = std::make_unique<SelfDriver>(navigation_of(scenario), robot.style.speed_m_s, world,
                                             *driving.map, driving.walls, start, goals, seed,
                                             stream_key(robot.name));
  return {robot, std::move(driver), seed};
}

}  // namespace tagfield
