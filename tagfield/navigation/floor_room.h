// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where on a map the robot's centre may be, and how gladly.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "tagfield/map/occupancy_grid.h"

namespace tagfield {

/// The robot is a circle, which holds its outline whichever way it is turned.
struct RobotRoom {
  double radius_m = 0.36;
  double margin_m = 0.05;
  double clearance_m = 0.3;

  /// Least distance of the robot's centre from an obstacle [m].
  [[nodiscard]] double least_m() const { return radius_m + margin_m; }
};

/// A map made ready for planning.
struct FloorRoom {
  /// Weight 0: the robot's centre may not be there.
  static constexpr std::uint8_t kFar = 4;    ///< With all the clearance that is wanted.
  static constexpr std::uint8_t kNear = 20;  ///< With none of it.
  static constexpr std::uint8_t kOut = 40;   ///< Nearer than allowed, on the way out of there.

  /// Cells are 0, 100 or -1 only.
  OccupancyGrid grid;
  /// Cost of a metre through a cell; row by row as the grid.
  std::vector<std::uint8_t> weights;

  [[nodiscard]] std::uint8_t weight(int x, int y) const {
    return grid.contains(x, y) ? weights[grid.index(x, y)] : std::uint8_t{0};
  }
};

/// Cells nearer than radius + margin to an occupied one, centre to centre, have weight 0, others
/// kFar + (kNear − kFar)(1 − s/clearance)² where s < clearance is the room beyond that. Unknown
/// cells have weight 0, and so have those nearer to unknown ground than kUnknownShare of the
/// radius. `seen` are points of obstacles that are not on the map. The ground within the radius of
/// `robot` counts as free where it is unknown, since the robot stands on it; and where it stands
/// nearer to obstacles than allowed, cells around it that are no nearer have weight kOut.
FloorRoom floor_room(const OccupancyGrid& map, const std::vector<Eigen::Vector2d>& seen,
                     const std::optional<Eigen::Vector2d>& robot, const RobotRoom& size);

/// How much of the radius must lie on known ground: the robot sees what is ahead before it is
/// there, but it should not brush along what was never seen.
inline constexpr double kUnknownShare = 0.7;

/// Distance from `p` to the nearest edge of an occupied cell [m]: 0 inside of one, at most
/// `most_m`.
double distance_to_occupied(const OccupancyGrid& map, const Eigen::Vector2d& p, double most_m);

/// `map` with cells 0, 100 and -1 only, where unknown cells that lie alone or in lines one cell
/// wide between free ones are free: far from the laser its beams pass cells by.
OccupancyGrid without_specks(const OccupancyGrid& map);

}  // namespace tagfield
