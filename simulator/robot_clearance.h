/// @file
/// How near a robot comes to what stands in the world.
#pragma once

#include <vector>

#include "simulator/obstacle.h"
#include "tagfield/map/occupancy_grid.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/world/scene.h"

namespace tagfield {

/// A robot seen from above: a rectangle about its base, x forward. The default is a P3-AT with its
/// wheels.
struct RobotOutline {
  double length_m = 0.51;
  double width_m = 0.50;
  double height_m = 0.36;
};

/// The world's solids between the floor and the robot's height, from above.
class RobotClearance {
 public:
  RobotClearance(const Scene& scene, const RobotOutline& outline);

  /// Least distance from the robot's rim to a solid or an obstacle [m], to 3 cm below and nothing
  /// above; 0 or less where they touch. At most 2 m.
  [[nodiscard]] double distance(const PlanarPose& pose_W, const Obstacles& obstacles) const;

 private:
  RobotOutline outline_;
  OccupancyGrid grid_;
  std::vector<float> distances_;
};

}  // namespace tagfield
