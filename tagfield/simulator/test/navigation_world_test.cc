// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/navigation_world.h"

#include <gtest/gtest.h>

#include <string>

#include "tagfield/base/test/temporary_folder.h"
#include "tagfield/base/units.h"
#include "tagfield/map/map_file.h"
#include "tagfield/simulator/test/small_world.h"

namespace tagfield {
namespace {

std::string complaint(const Scenario& scenario, const Scene& scene = small_room()) {
  Diagnostics diagnostics;
  try {
    navigation_world(scenario, scene, diagnostics);
  } catch (const Error& error) {
    return error.what();
  }
  return "no complaint";
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(NavigationWorld, KnowsTheFloorThatARobotCanGetTo) {
  Diagnostics diagnostics;
  const NavigationWorld world = navigation_world(small_drive(), small_room(), diagnostics);
  // 0.36 m + 0.05 m + two cells from the walls of 6 m by 4 m.
  ASSERT_FALSE(world.floor.empty());
  for (const Eigen::Vector2d& p : world.floor) {
    EXPECT_LE(std::abs(p.x()), 3.0 - 0.51);
    EXPECT_LE(std::abs(p.y()), 2.0 - 0.51);
  }
  EXPECT_FALSE(world.given_map.has_value());
  const Eigen::Vector2i wall = world.true_map.cell_of({3.02, 0.0});
  EXPECT_TRUE(is_occupied(world.true_map.at(wall.x(), wall.y())));
}

TEST(NavigationWorld, TellsTheDriverWhatIsLow) {
  Scene scene = small_room();
  scene.collisions.push_back(box_at(1.0, 0.5, 0.4, 0.4, 0.1, 0.2));
  Scenario scenario = small_drive();
  Diagnostics diagnostics;
  const NavigationWorld world = navigation_world(scenario, scene, diagnostics);
  const Eigen::Vector2i cell = world.true_map.cell_of({1.0, 0.5});
  EXPECT_TRUE(is_free(world.true_map.at(cell.x(), cell.y())));
  const OccupancyGrid map = driving_map(world.true_map, world);
  EXPECT_TRUE(is_occupied(map.at(cell.x(), cell.y())));
  own_navigation(scenario).keep_out = false;
  const NavigationWorld blind = navigation_world(scenario, scene, diagnostics);
  EXPECT_TRUE(is_free(driving_map(blind.true_map, blind).at(cell.x(), cell.y())));
}

TEST(NavigationWorld, RefusesRobotsInWalls) {
  Scenario scenario = small_drive();
  scenario.robots[0].location = {"s.yaml", 9};
  scenario.robots[0].start = {2.9, 0.0, 0.0};
  EXPECT_TRUE(holds(complaint(scenario), "s.yaml:9: robots[0].start (2.90, 0.00) puts the robot"))
      << complaint(scenario);
  scenario.robots[0].start = {0.0, 0.0, 0.0};
  scenario.robots[0].kidnapped = {{Time{}, PlanarPose{0.5, 0.0, 0.0}, {"s.yaml", 10}},
                                  {Time{}, PlanarPose{2.5, 1.6, 0.0}, {"s.yaml", 11}}};
  EXPECT_TRUE(holds(complaint(scenario), "s.yaml:11: robots[0].kidnapped[1] (2.50, 1.60)"));
  scenario.robots[0].kidnapped.pop_back();
  EXPECT_EQ(complaint(scenario), "no complaint");
  ObstacleSpec box;
  box.radius_m = 0.3;
  box.motion = {{Time{}, from_translation({0.7, 0.2, 0.0})}};
  scenario.obstacles = {box};
  EXPECT_TRUE(holds(complaint(scenario), "robots[0].kidnapped[0]"));
  scenario.obstacles.clear();
  scenario.robots[0].kidnapped[0].to_W = PlanarPose{0.0, 9.0, 0.0};
  EXPECT_TRUE(holds(complaint(scenario), "robots[0].kidnapped[0] (0.00, 9.00) is not on a floor"));
}

TEST(NavigationWorld, RefusesRobotsInRobots) {
  Scenario scenario = small_drive();
  scenario.robots.push_back(scenario.robots[0]);
  scenario.robots[1].name = "second";
  scenario.robots[1].location = {"s.yaml", 12};
  EXPECT_TRUE(holds(complaint(scenario), "s.yaml:12: robots[1].start (")) << complaint(scenario);
  EXPECT_TRUE(holds(complaint(scenario), "puts the robot into robot '" + scenario.robots[0].name));
  scenario.robots[1].start.x += 0.6;
  EXPECT_EQ(complaint(scenario), "no complaint");
}

TEST(NavigationWorld, RefusesAStartBesideTheGivenMap) {
  OccupancyGrid map;
  map.width = map.height = 20;
  map.resolution_m = 0.05;
  map.origin = {1.0, 1.0};
  map.cells.assign(400, 0);
  map.cells[0] = 100;
  Scenario scenario = small_drive();
  own_navigation(scenario).map = folder_of_test().with("b.yaml", map_to_yaml(map, "b.pgm"));
  (void)folder_of_test().with("b.pgm", map_to_pgm(map));
  EXPECT_TRUE(holds(complaint(scenario), "which is from (1.00, 1.00) to (2.00, 2.00)"))
      << complaint(scenario);
  own_navigation(scenario).start = StartBelief::kRandom;
  EXPECT_EQ(complaint(scenario), "no complaint");
}

TEST(NavigationWorld, NeedsAWorldAndSomewhereToGo) {
  Scenario scenario = small_drive();
  scenario.world.path.clear();
  EXPECT_TRUE(holds(complaint(scenario), "needs a world"));
  scenario = small_drive();
  scenario.robots[0].waypoints.clear();
  EXPECT_TRUE(holds(complaint(scenario), "waypoints or goals"));
  scenario.robots[0].random_goals = 3;
  EXPECT_EQ(complaint(scenario), "no complaint");
}

/// A given map with a single value everywhere is unusable.
TEST(NavigationWorld, RefusesMapsWithoutWallsOrFloor) {
  OccupancyGrid map;
  map.width = map.height = 20;
  Scenario scenario = small_drive();
  own_navigation(scenario).map = folder_of_test().with("m.yaml", map_to_yaml(map, "m.pgm"));
  for (const auto& [cell, says] :
       {std::pair{0, "no occupied cell"}, {100, "no free cell"}, {-1, "no free cell"}}) {
    map.cells.assign(400, static_cast<std::int8_t>(cell));
    (void)folder_of_test().with("m.pgm", map_to_pgm(map));
    EXPECT_TRUE(holds(complaint(scenario), says)) << complaint(scenario);
    EXPECT_TRUE(holds(complaint(scenario), "m.yaml"));
  }
}

}  // namespace
}  // namespace tagfield
