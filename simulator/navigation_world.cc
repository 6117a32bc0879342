#include "simulator/navigation_world.h"

#include "navigation/keep_out.h"
#include "tagfield/map/map_file.h"
#include "tagfield/map/true_map.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

/// What is lower is a floor, or its unevenness, which a P3-AT's wheels roll over [m].
constexpr double kThreshold = 0.06;

}  // namespace

const RobotSpec& mapping_robot(const Scenario& scenario) {
  for (const RobotSpec& robot : scenario.robots) {
    if (!robot.waypoints.empty()) return robot;
  }
  throw Error("navigation 'slam' needs a robot with waypoints to drive to");
}

NavigationWorld navigation_world(const Scenario& scenario, const Scene& scene,
                                 Diagnostics& diagnostics) {
  if (scenario.world.path.empty()) {
    throw Error("navigation 'slam' needs a world: the scenario has no 'world'");
  }
  const NavigationSpec& navigation = scenario.navigation;
  const double laser_height = navigation.laser.X_RL.translation.z();
  const Eigen::Vector2d start = position_of(mapping_robot(scenario).start);
  NavigationWorld world{{std::make_shared<const RayScene>(scene), scenario.obstacles},
                        {},
                        std::nullopt,
                        true_map(scene, laser_height, start, navigation.mapper.resolution_m),
                        RobotClearance(scene, RobotOutline{})};
  if (navigation.keep_out) world.low_things = top_view(scene, kThreshold, laser_height);
  if (!navigation.map.empty()) world.given_map = read_map(navigation.map, diagnostics);
  return world;
}

OccupancyGrid driving_map(const OccupancyGrid& map, const NavigationWorld& world) {
  if (world.low_things.empty()) return map;
  return with_keep_out(map, world.low_things, {});
}

}  // namespace tagfield
