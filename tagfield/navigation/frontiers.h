// SPDX-License-Identifier: Apache-2.0
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

/// A look at a place.
struct Viewpoint {
  PlanarPose from_M;     ///< Where to stand, with the place ahead.
  Eigen::Vector2d at_M;  ///< The place.
};

/// A frontier is a connected row of free cells beside unknown ones that the robot could see into
/// (Yamauchi, 1997).
struct Frontier {
  Viewpoint look;       ///< At its middle, or a part that can be seen.
  double size_m = 0.0;  ///< Its length.
  double way_m = 0.0;   ///< Length of the way to where to look from.
};

/// All on `map` that can be looked into from where the robot at `pose_M` can drive, best first
/// (near and large). `drivable` is the same map with what else is known to be in the way, such as
/// things too low for the laser. Places within 0.5 m of one that was looked at are left out, as are
/// looks from where there was one in nearly the same direction: `looks` that did not close a
/// frontier won't. Throws Error on maps of different size.
std::vector<Frontier> frontiers(const OccupancyGrid& map, const OccupancyGrid& drivable,
                                const PlanarPose& pose_M, const std::vector<Viewpoint>& looks,
                                const FrontierOptions& options);

/// Whether a free cell within `reach_m` along x and y of the finite `p_M` has an unknown neighbour.
bool has_frontier_near(const OccupancyGrid& map, const Eigen::Vector2d& p_M, double reach_m);

}  // namespace tagfield
