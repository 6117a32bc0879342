// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where to drive next to see what is still unknown.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "tagfield/map/occupancy_grid.h"
#include "tagfield/motion/unicycle.h"

namespace tagfield {

struct FrontierOptions {
  double radius_m = 0.36;  ///< Of the robot's footprint.
  double margin_m = 0.05;
  double min_size_m = 0.4;  ///< Frontiers shorter than this are not worth the drive.
  double sight_m = 8.0;     ///< The range up to which the laser is trusted.
};

/// A look at a point.
struct Viewpoint {
  PlanarPose from_M;     ///< Where to stand, facing the point.
  Eigen::Vector2d at_M;  ///< The point looked at.
};

/// A frontier: a connected set of free cells next to unknown ones that the robot could see into
/// (Yamauchi, 1997).
struct Frontier {
  Viewpoint look;       ///< At its middle, or at a part that can be seen.
  double size_m = 0.0;  ///< Its length.
  double way_m = 0.0;   ///< Length of the path to the viewpoint.
};

/// All frontiers of `map` that can be seen from somewhere the robot at `pose_M` can drive to, best
/// first (near and large). `drivable` is the same map with other known obstacles added, such as
/// those too low for the laser. Excludes points within 0.5 m of one in `looks`, and viewpoints near
/// one in `looks` with nearly the same direction: a look that did not close a frontier the first
/// time won't do so the second time. Throws Error on maps of different size.
std::vector<Frontier> frontiers(const OccupancyGrid& map, const OccupancyGrid& drivable,
                                const PlanarPose& pose_M, const std::vector<Viewpoint>& looks,
                                const FrontierOptions& options);

/// Whether any free cell within `reach_m` of `p_M` along x and y has an unknown neighbour. `p_M`
/// must be finite.
bool has_frontier_near(const OccupancyGrid& map, const Eigen::Vector2d& p_M, double reach_m);

}  // namespace tagfield
