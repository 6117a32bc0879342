/// @file
/// Where to drive next to see what is not known yet.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "tagfield/map/occupancy_grid.h"
#include "tagfield/motion/unicycle.h"

namespace tagfield {

struct FrontierOptions {
  double radius_m = 0.36;  ///< Of the robot's outline.
  double margin_m = 0.05;
  double least_size_m = 0.4;  ///< Frontiers shorter than this are not worth the way.
  double sight_m = 8.0;       ///< How far the laser is trusted to see.
};

/// A frontier is a connected row of free cells beside unknown ones that the robot could see into
/// (Yamauchi, 1997).
struct Frontier {
  PlanarPose goal;      ///< Where to stand, looking at the frontier [map].
  double size_m = 0.0;  ///< Its length.
  double way_m = 0.0;   ///< Length of the way to the goal.
};

/// All that can be reached from `pose_M`, best first (near and large). Goals within 0.5 m of one of
/// `given_up` are left out.
std::vector<Frontier> frontiers(const OccupancyGrid& map, const PlanarPose& pose_M,
                                const std::vector<Eigen::Vector2d>& given_up,
                                const FrontierOptions& options);

}  // namespace tagfield
