// SPDX-License-Identifier: Apache-2.0
/// @file
/// The map that a perfect survey would yield, and the comparison of a real map with it.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "tagfield/map/occupancy_grid.h"
#include "tagfield/world/scene.h"

namespace tagfield {

/// Cuts the world's solids at height `z_m`: cells crossed by a surface are occupied (100), cells
/// connected to `start` through cells without a surface are free (0), and all others (interiors of
/// solids, inaccessible rooms) are unknown (-1). Only surfaces adjacent to free cells, at a side or
/// a corner, stay occupied, as no laser sees the others.
///
/// The grid covers all surfaces within `reach_m` of the start, along x and y each, with a margin of
/// 1 m; nothing beyond the reach is free. Cell borders are integer multiples of the resolution. A
/// surface on a border belongs to the cell of greater x or y. A solid whose underside is at `z_m`
/// is not cut, one whose top is there is. Throws Error on a start that is not finite or in a cell
/// with a surface, on a resolution or reach that is not positive, and on more than 4e8 cells.
OccupancyGrid true_map(const Scene& scene, double z_m, const Eigen::Vector2d& start,
                       double resolution_m, double reach_m = 100.0);

/// Comparison of two maps in the same frame. A share of no cells is 0.
struct MapComparison {
  std::size_t true_cells = 0;    ///< Occupied in truth.
  std::size_t mapped_cells = 0;  ///< Occupied in the map.
  double found_share = 0.0;      ///< True cells with a mapped one within one cell.
  double false_share = 0.0;      ///< Mapped cells with no true one within two cells.
  /// True cells that are found and have a second, false one 3 to 8 cells away across free space: in
  /// the straight line of cells between the two, all except the first, which a thick wall may fill,
  /// are free in the map.
  double double_wall_share = 0.0;
  double known_share = 0.0;  ///< Truly free cells that are free in the map.
};

/// "Within n cells" refers to rows and columns separately (Chebyshev distance of cell centres). The
/// map is aligned with the truth's cells, which moves it by at most half a cell. Throws Error if
/// their resolutions differ.
MapComparison compare_maps(const OccupancyGrid& map, const OccupancyGrid& truth);

}  // namespace tagfield
