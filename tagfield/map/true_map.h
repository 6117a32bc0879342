// SPDX-License-Identifier: Apache-2.0
/// @file
/// The map that a perfect survey would make, and how near a real one comes.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "tagfield/map/occupancy_grid.h"
#include "tagfield/world/scene.h"

namespace tagfield {

/// Cuts the world's solids at height `z_m`: cells that a surface passes through are occupied (100),
/// cells from which `start` can be reached over cells without surface are free (0), all else
/// (insides of solids, rooms that can't be entered) is unknown (-1). Only the surfaces that border
/// on free cells, at a side or a corner, stay occupied, since no laser sees the others.
///
/// The grid covers all surfaces within `reach_m` of the start, along x and y each, by a margin of
/// 1 m, and nothing beyond the reach is free; the borders of its cells are whole multiples of the
/// resolution. A surface on such a border is in the cell of greater x or y. A solid whose underside
/// is at `z_m` is not cut, one whose top is there is. Throws Error on a start that is not finite or
/// in a cell with a surface, on a resolution or reach that is not positive, and on more than 4e8
/// cells.
OccupancyGrid true_map(const Scene& scene, double z_m, const Eigen::Vector2d& start,
                       double resolution_m, double reach_m = 100.0);

/// Both maps in one frame. A share of nothing is 0.
struct MapComparison {
  std::size_t true_cells = 0;    ///< Occupied in truth.
  std::size_t mapped_cells = 0;  ///< Occupied in the map.
  double found_share = 0.0;      ///< Of the true ones, those with a mapped one within one cell.
  double false_share = 0.0;      ///< Of the mapped ones, those with no true one within two cells.
  /// Of the true ones, those that are found and have a second, false one 3 to 8 cells away across
  /// free cells: of the straight line of cells between the two all but the first, which a thick
  /// wall may fill, are free in the map.
  double double_wall_share = 0.0;
  double known_share = 0.0;  ///< Of the truly free cells, those that the map knows as free.
};

/// "Within n cells" is by row and column, each (Chebyshev distance of the cells' centres). The map
/// is laid onto the truth's cells, which moves it by less than half a cell. Throws Error if their
/// resolutions differ.
MapComparison compare_maps(const OccupancyGrid& map, const OccupancyGrid& truth);

}  // namespace tagfield
