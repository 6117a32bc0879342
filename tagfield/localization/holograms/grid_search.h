/// @file
/// Search of an area for its brightest places, from coarse to fine: cells that were bright are
/// split, and looked at more closely.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace tagfield {

/// So many places are worked on at once.
inline constexpr int kTile = 64;
using Tile = Eigen::Array<float, kTile, 1>;

/// A cell is split into so many by so many.
inline constexpr int kGridSplit = 3;

/// The coarsest grid: a square of cells.
struct Grid {
  Eigen::Vector2d middle;  ///< [m]
  double cell_m = 0.25;
  double reach_m = 12.0;  ///< From the middle to an edge.
};

/// How bright the places (x, y) of a tile are, relative to the grid's middle [m].
using GridLevel = std::function<Tile(const Tile& x, const Tile& y)>;

struct GridMaximum {
  Eigen::Vector2d p;  ///< [m]
  float brightness = 0.0f;
};

/// The brightest local maxima on the finest grid, at least 5 cm apart, brightest first, at most
/// `count`. The first level is of the cells that are `within`, each further one of cells a third as
/// wide, where the one before was bright. None where there is no cell. At least one level.
std::vector<GridMaximum> search_grid(const Grid& grid,
                                     const std::function<bool(const Eigen::Vector2d& p)>& within,
                                     const std::vector<GridLevel>& levels, std::size_t count);

}  // namespace tagfield
