// SPDX-License-Identifier: Apache-2.0
/// @file
/// A costmap: where on a map the robot's centre may be, and at what cost.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "tagfield/map/occupancy_grid.h"

namespace tagfield {

/// The robot is modelled as a circle that contains its footprint at any heading.
struct RobotRoom {
  double radius_m = 0.36;
  double margin_m = 0.05;
  double clearance_m = 0.3;

  /// Least distance of the robot's centre from an obstacle [m].
  [[nodiscard]] double min_m() const { return radius_m + margin_m; }
};

/// A map prepared for planning.
struct FloorRoom {
  /// Weight 0: the robot's centre may not be there.
  static constexpr std::uint8_t kFar = 4;    ///< With the full desired clearance.
  static constexpr std::uint8_t kNear = 20;  ///< With no clearance beyond the minimum.
  static constexpr std::uint8_t kOut = 40;   ///< Nearer than allowed, to let the robot get out.

  /// Cells are only 0, 100 or -1.
  OccupancyGrid grid;
  /// Cost of a metre through a cell, in row-major order like the grid.
  std::vector<std::uint8_t> weights;

  [[nodiscard]] std::uint8_t weight(int x, int y) const {
    return grid.contains(x, y) ? weights[grid.index(x, y)] : std::uint8_t{0};
  }
};

/// Cells nearer to an occupied cell than radius + margin, centre to centre, have weight 0, and
/// others kFar + (kNear − kFar)(1 − s/clearance)² where s < clearance is their distance beyond
/// that. Unknown cells have weight 0, and so do those nearer to unknown cells than kUnknownShare of
/// the radius. `seen` are points of obstacles that are not on the map. Unknown cells within the
/// radius of `robot` count as free, since the robot stands on them. If the robot is nearer to
/// obstacles than allowed, cells around it that are no nearer to them have weight kOut.
FloorRoom floor_room(const OccupancyGrid& map, const std::vector<Eigen::Vector2d>& seen,
                     const std::optional<Eigen::Vector2d>& robot, const RobotRoom& size);

/// Share of the radius that must lie in known space: the robot sees what is ahead before it gets
/// there, but it should not brush past what was never seen.
inline constexpr double kUnknownShare = 0.7;

/// Distance from `p` to the nearest edge of an occupied cell [m]: 0 inside one, at most `max_m`.
double distance_to_occupied(const OccupancyGrid& map, const Eigen::Vector2d& p, double max_m);

/// `map` with cells 0, 100 and -1 only, in which isolated unknown cells and unknown lines one cell
/// wide between free cells are free: far from the laser, its beams miss some cells.
OccupancyGrid without_specks(const OccupancyGrid& map);

}  // namespace tagfield
