/// @file
/// The map that a perfect survey would make, and how near a real one comes.
#pragma once

#include "tagfield/map/occupancy_grid.h"
#include "tagfield/world/scene.h"

namespace tagfield {

/// Cuts the world's solids at height `z_m`: cells that a surface passes through are occupied (100),
/// cells from which `start` can be reached over cells without surface are free (0), all else
/// (insides of solids, rooms that can't be entered) is unknown (-1). The grid covers all surfaces
/// within `reach_m` of the start, by a margin of 1 m. Only the surfaces that border on free cells
/// stay occupied, since no laser sees the others.
OccupancyGrid true_map(const Scene& scene, double z_m, const Eigen::Vector2d& start,
                       double resolution_m, double reach_m = 100.0);

/// Both maps in one frame.
struct MapComparison {
  std::size_t true_cells = 0;      ///< Occupied in truth.
  std::size_t mapped_cells = 0;    ///< Occupied in the map.
  double found_share = 0.0;        ///< Of the true ones, those with a mapped one within one cell.
  double false_share = 0.0;        ///< Of the mapped ones, those with no true one within two cells.
  double double_wall_share = 0.0;  ///< Of the true ones, those with mapped ones 3 to 8 cells away
                                   ///< across free cells, where the truth has none.
  double known_share = 0.0;        ///< Of the truly free cells, those that the map knows as free.
};

/// "Within n cells" is by row and column, each (Chebyshev distance of the cells' centres).
MapComparison compare_maps(const OccupancyGrid& map, const OccupancyGrid& truth);

}  // namespace tagfield
