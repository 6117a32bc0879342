#include "simulator/navigation_world.h"

#include "navigation/keep_out.h"
#include "tagfield/map/map_file.h"
#include "tagfield/map/true_map.h"
#include "tagfield/map/visible_map.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

/// What is lower is a floor, or its unevenness, which a P3-AT's wheels roll over [m].
constexpr double kThreshold = 0.06;

double laser_height(const NavigationSpec& navigation) {
  return navigation.laser.X_RL.translation.z();
}

/// What a laser on the robot can see of the world. False walls are counted against all that is
/// there, so cells seen by nobody stay as they are.
OccupancyGrid visible_truth(const Scene& scene, const NavigationSpec& navigation,
                            const Eigen::Vector2d& start) {
  const OccupancyGrid truth =
      true_map(scene, laser_height(navigation), start, navigation.mapper.resolution_m);
  return visible_map(truth, start, navigation.driver.radius_m);
}

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
  const Eigen::Vector2d start = position_of(mapping_robot(scenario).start);
  NavigationWorld world{{std::make_shared<const RayScene>(scene), scenario.obstacles},
                        {},
                        std::nullopt,
                        visible_truth(scene, navigation, start),
                        RobotClearance(scene, RobotOutline{})};
  if (navigation.keep_out) world.low_things = top_view(scene, kThreshold, laser_height(navigation));
  if (!navigation.map.empty()) world.given_map = read_map(navigation.map, diagnostics);
  return world;
}

OccupancyGrid driving_map(const OccupancyGrid& map, const NavigationWorld& world) {
  if (world.low_things.empty()) return map;
  return with_keep_out(map, world.low_things, {});
}

}  // namespace tagfield
