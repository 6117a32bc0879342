// SPDX-License-Identifier: Apache-2.0
/// @file
/// Paths over a map that keep clear of its walls. docs/driving.md has the equations.
///
/// A* and Dijkstra's algorithm on the cells of a FloorRoom.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/motion/unicycle.h"
#include "tagfield/navigation/floor_room.h"

namespace tagfield {

/// The cheapest paths from one cell to all others.
struct Spread {
  static constexpr std::int32_t kUnreached = -1;
  static constexpr std::uint8_t kNowhere = 255;
  /// About 12 for the length of a cell at weight 1; in row-major order like the grid.
  std::vector<std::int32_t> costs;
  /// Which of the eight neighbours leads back to the start; kNowhere at the start and at unreached
  /// cells.
  std::vector<std::uint8_t> back;
};

/// Searches from cell `from` over cells of nonzero weight; ends early once `until` is reached.
Spread spread(const FloorRoom& floor, const Eigen::Vector2i& from,
              const std::optional<Eigen::Vector2i>& until = std::nullopt);

/// The cells from `cell`, which must have been reached, back to the start, both included.
std::vector<Eigen::Vector2i> backtrack(const FloorRoom& floor, const Spread& spread,
                                       const Eigen::Vector2i& cell);

/// A path with fewer corners: straight segments that pass only allowed cells and cost no more than
/// the cell-to-cell steps that they replace.
std::vector<Eigen::Vector2d> straightened(const FloorRoom& floor,
                                          const std::vector<Eigen::Vector2d>& way);

/// A path, or why there is none.
struct Plan {
  std::vector<Eigen::Vector2d> way;  ///< From the robot to the goal, both included [map].
  std::string refusal;               ///< One line; "" if there is a path.
};

/// What is wrong with the goal or the robot's position on `map`, checked before any search for a
/// path; "" if nothing. The goal must be finite, in free space on the map and as far from obstacles
/// as `size` requires. The robot must be on the map and not inside an obstacle.
std::string fault_of(const OccupancyGrid& map, const PlanarPose& pose_M, const PlanarPose& goal_M,
                     const RobotRoom& size);

/// Plans a path on `map` with additional obstacles at the points `seen`.
Plan plan(const OccupancyGrid& map, const std::vector<Eigen::Vector2d>& seen,
          const PlanarPose& pose_M, const PlanarPose& goal_M, const RobotRoom& size);

}  // namespace tagfield
