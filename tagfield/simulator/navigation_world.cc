// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/navigation_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "tagfield/map/map_file.h"
#include "tagfield/map/true_map.h"
#include "tagfield/map/visible_map.h"
#include "tagfield/motion/planar_pose.h"
#include "tagfield/navigation/keep_out.h"
#include "tagfield/simulator/robot_clearance.h"

namespace tagfield {
namespace {

/// Additional distance of random poses from everything, in cells of the map.
constexpr double kSpareCells = 2.0;

double laser_height(const NavigationSpec& navigation) {
  return navigation.laser.X_RL.translation.z();
}

/// What a laser on the robot can see of the world. False walls are counted against everything that
/// exists, so cells that nobody can see stay as they are.
OccupancyGrid visible_truth(const Scene& scene, const NavigationSpec& navigation,
                            const RobotSpec& robot, double resolution_m) {
  const Eigen::Vector2d start = position_of(robot.start);
  try {
    const OccupancyGrid truth = true_map(scene, laser_height(navigation), start, resolution_m);
    return visible_map(truth, start, navigation.driver.radius_m);
  } catch (const Error& error) {
    fail(robot.location, fmt::format("robot '{}': {}", robot.name, error.what()));
  }
}

/// "robots[0].start (1.00, 2.00)"
std::string place_name(const std::string& element, const PlanarPose& pose) {
  return fmt::format("{} ({:.2f}, {:.2f})", element, pose.x, pose.y);
}

void require_room(const RobotClearance& clearance, const Obstacles& obstacles,
                  const PlanarPose& pose, const Location& location, const std::string& element) {
  if (clearance.distance(pose, obstacles) > 0.0) return;
  fail(location, place_name(element, pose) + " puts the robot into a wall or an obstacle");
}

void require_good_starts(const Scenario& scenario, const RobotClearance& clearance) {
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    const RobotSpec& robot = scenario.robots[i];
    if (!drives(robot)) continue;
    require_room(clearance, obstacles_at(scenario.obstacles, Time{}), robot.start, robot.location,
                 fmt::format("robots[{}].start", i));
  }
}

/// Robots do not avoid one another, but they can't start inside one another.
void require_starts_apart(const Scenario& scenario, const RobotClearance& clearance) {
  const std::vector<RobotSpec>& robots = scenario.robots;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!drives(robots[i]) || !drives(robots[j])) continue;
      if (clearance.distance_between(robots[j].start, robots[i].start) > 0.0) continue;
      fail(robots[i].location,
           fmt::format("{} puts the robot into robot '{}'",
                       place_name(fmt::format("robots[{}].start", i), robots[i].start),
                       robots[j].name));
    }
  }
}

/// Robots that know where they are must be on the map that they are given.
void require_starts_on(const OccupancyGrid& map, const Scenario& scenario) {
  const NavigationSpec& navigation = navigation_of(scenario);
  if (navigation.start == StartBelief::kRandom) return;
  const Eigen::Vector2d far_corner =
      map.origin + map.resolution_m * Eigen::Vector2d(map.width, map.height);
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    const RobotSpec& robot = scenario.robots[i];
    const Eigen::Vector2i cell = map.cell_of(position_of(robot.start));
    if (!drives(robot) || map.contains(cell.x(), cell.y())) continue;
    fail(robot.location,
         fmt::format("{} is not on the map {}, which is from ({:.2f}, {:.2f}) to ({:.2f}, {:.2f})",
                     place_name(fmt::format("robots[{}].start", i), robot.start), navigation.map,
                     map.origin.x(), map.origin.y(), far_corner.x(), far_corner.y()));
  }
}

/// Throws Error if a robot is kidnapped into something, or out of the world.
void require_good_carryings(const Scenario& scenario, const RobotClearance& clearance,
                            const OccupancyGrid& truth) {
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    const std::vector<Kidnapping>& kidnapped = scenario.robots[i].kidnapped;
    for (std::size_t j = 0; j < kidnapped.size(); ++j) {
      if (!kidnapped[j].to_W) continue;
      const PlanarPose& to_W = *kidnapped[j].to_W;
      const std::string element = fmt::format("robots[{}].kidnapped[{}]", i, j);
      require_room(clearance, obstacles_at(scenario.obstacles, kidnapped[j].when), to_W,
                   kidnapped[j].location, element);
      const Eigen::Vector2i cell = truth.cell_of(position_of(to_W));
      if (is_free(truth.at(cell.x(), cell.y()))) continue;
      fail(kidnapped[j].location,
           place_name(element, to_W) +
               " is not on a floor that can be seen from where a robot can go");
    }
  }
}

/// Whether a random pose is needed for a robot.
bool draws_places(const Scenario& scenario) {
  return navigation_of(scenario).start == StartBelief::kRandom ||
         std::any_of(scenario.robots.begin(), scenario.robots.end(), [](const RobotSpec& robot) {
           return robot.random_goals > 0 ||
                  std::any_of(robot.kidnapped.begin(), robot.kidnapped.end(),
                              [](const Kidnapping& kidnapping) { return !kidnapping.to_W; });
         });
}

OccupancyGrid usable_map(const std::string& path, Diagnostics& diagnostics) {
  OccupancyGrid map = read_map(path, diagnostics);
  if (std::none_of(map.cells.begin(), map.cells.end(), is_free)) {
    fail({path, 0}, "has no free cell, so a robot can't be on it");
  }
  if (std::none_of(map.cells.begin(), map.cells.end(), is_occupied)) {
    fail({path, 0}, "has no occupied cell, so nothing on it can be recognized");
  }
  return map;
}

}  // namespace

const RobotSpec& mapping_robot(const Scenario& scenario) {
  for (const RobotSpec& robot : scenario.robots) {
    if (drives(robot)) return robot;
  }
  throw Error("navigation 'slam' needs a robot with waypoints or goals to drive to");
}

NavigationWorld navigation_world(const Scenario& scenario, const Scene& scene,
                                 Diagnostics& diagnostics) {
  if (scenario.world.path.empty()) {
    throw Error("navigation 'slam' needs a world: the scenario has no 'world'");
  }
  const NavigationSpec& navigation = navigation_of(scenario);
  const RobotSpec& robot = mapping_robot(scenario);
  const Eigen::Vector2d start = position_of(robot.start);
  RobotClearance clearance(scene, RobotOutline{});
  require_good_starts(scenario, clearance);
  require_starts_apart(scenario, clearance);
  std::optional<OccupancyGrid> given;
  if (!navigation.map.empty()) {
    given = usable_map(navigation.map, diagnostics);
    require_starts_on(*given, scenario);
  }
  const double resolution_m = given ? given->resolution_m : navigation.mapper.resolution_m;
  NavigationWorld world{{std::make_shared<const RayScene>(scene), scenario.obstacles},
                        {},
                        std::move(given),
                        visible_truth(scene, navigation, robot, resolution_m),
                        std::move(clearance),
                        {}};
  require_good_carryings(scenario, world.clearance, world.true_map);
  const double radius_m =
      navigation.driver.radius_m + navigation.driver.margin_m + kSpareCells * resolution_m;
  world.floor =
      reachable_floor(world.true_map, world.clearance, scenario.obstacles, start, radius_m);
  if (world.floor.empty() && draws_places(scenario)) {
    fail(
        robot.location,
        fmt::format("robot '{}' has no floor around its start to draw positions from", robot.name));
  }
  if (navigation.keep_out)
    world.low_things = top_view(scene, kRolledOver, laser_height(navigation));
  return world;
}

OccupancyGrid driving_map(const OccupancyGrid& map, const NavigationWorld& world) {
  if (world.low_things.empty()) return map;
  return with_keep_out(map, world.low_things, {});
}

}  // namespace tagfield
