// SPDX-License-Identifier: Apache-2.0
/// @file
/// Ways over a map that keep clear of its walls. docs/driving.md has the equations.
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

/// The cheapest ways from one cell to all others.
struct Spread {
  static constexpr std::int32_t kUnreached = -1;
  static constexpr std::uint8_t kNowhere = 255;
  /// About 12 for the length of a cell at weight 1; row by row as the grid.
  std::vector<std::int32_t> costs;
  /// Which of the eight neighbours leads back to the start; kNowhere at it and where unreached.
  std::vector<std::uint8_t> back;
};

/// From cell `from` over cells with weight; ends early once `until` is reached.
Spread spread(const FloorRoom& floor, const Eigen::Vector2i& from,
              const std::optional<Eigen::Vector2i>& until = std::nullopt);

/// The cells from `cell`, which was reached, back to the start, with both.
std::vector<Eigen::Vector2i> way_back(const FloorRoom& floor, const Spread& spread,
                                      const Eigen::Vector2i& cell);

/// A way with fewer corners: straight pieces that cost no more than the steps from cell to cell
/// that they replace, each cell that they pass being allowed.
std::vector<Eigen::Vector2d> straightened(const FloorRoom& floor,
                                          const std::vector<Eigen::Vector2d>& way);

/// A way, or why there is none.
struct Plan {
  std::vector<Eigen::Vector2d> way;  ///< From the robot to the goal [map]; both, where it is found.
  std::string refusal;               ///< One line; "" where there is a way.
};

/// What is wrong with the goal or the robot's place on `map`, before any way is looked for; "" for
/// nothing. The goal must be finite, on free ground of the map and as far from obstacles as `size`
/// says; the robot on the map and not in an obstacle.
std::string fault_of(const OccupancyGrid& map, const PlanarPose& pose_M, const PlanarPose& goal_M,
                     const RobotRoom& size);

/// The way on `map` with obstacles at the points `seen` besides.
Plan plan(const OccupancyGrid& map, const std::vector<Eigen::Vector2d>& seen,
          const PlanarPose& pose_M, const PlanarPose& goal_M, const RobotRoom& size);

}  // namespace tagfield
