// SPDX-License-Identifier: Apache-2.0
/// @file
/// Search of an area for its brightest places, from coarse to fine: cells that were bright are
/// split, and looked at more closely.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace tagfield {

class PlaneInReach;

/// So many places are worked on at once.
inline constexpr int kTile = 64;
using Tile = Eigen::Array<float, kTile, 1>;

/// What `of(x, y, z)` makes of each place, a tile at a time.
template <class Place, class OfTile>
std::vector<double> by_tiles(const std::vector<Place>& places, const OfTile& of) {
  std::vector<double> all(places.size());
  for (std::size_t begin = 0; begin < places.size(); begin += kTile) {
    const std::size_t count = std::min<std::size_t>(kTile, places.size() - begin);
    Tile x = Tile::Zero();
    Tile y = Tile::Zero();
    Tile z = Tile::Zero();
    for (std::size_t k = 0; k < count; ++k) {
      const auto at = static_cast<Eigen::Index>(k);
      x[at] = static_cast<float>(places[begin + k].x());
      y[at] = static_cast<float>(places[begin + k].y());
      z[at] = static_cast<float>(places[begin + k].z());
    }
    const Tile values = of(x, y, z);
    for (std::size_t k = 0; k < count; ++k) {
      all[begin + k] = static_cast<double>(values[static_cast<Eigen::Index>(k)]);
    }
  }
  return all;
}

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

/// So many by so many cells of the coarsest grid are glanced at together.
inline constexpr int kBlock = 16;

/// A square of such cells.
struct CellBlock {
  float x = 0.0f, y = 0.0f;  ///< Middle of its first cell, relative to the grid's middle [m].
  float cell_m = 0.0f;
};

/// Of the cell (x + i · cell_m, y + j · cell_m) in (i, j).
using BlockLight = Eigen::Array<float, kBlock, kBlock>;

/// Looks at the coarsest grid that cost less than its level.
struct GridGlances {
  /// About how bright the cells of a block are; empty where there are no glances.
  std::function<BlockLight(const CellBlock& block)> at_blocks;
  GridLevel at_cells{};  ///< By other reads, of the cells that are left; empty for no second look.
};

/// The cells of a block, a tile at a time.
BlockLight light_of_block(const GridLevel& brightness, const CellBlock& block);

struct GridMaximum {
  Eigen::Vector2d p;  ///< [m]
  float brightness = 0.0f;
};

/// The brightest local maxima on the finest grid, at least 5 cm apart, brightest first, at most
/// `count`. The first level is of the cells that are in reach, each further one of cells a third as
/// wide, where the one before was bright. None where there is no cell. At least one level. Of
/// glances, each leaves about the brightest tenth of the cells, the second 250 of them at least.
std::vector<GridMaximum> search_grid(const Grid& grid, const PlaneInReach& in_reach,
                                     const std::vector<GridLevel>& levels, std::size_t count,
                                     const GridGlances& glances = {});

}  // namespace tagfield
