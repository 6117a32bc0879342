// SPDX-License-Identifier: Apache-2.0
/// @file
/// Coarse-to-fine search of an area for its brightest points: bright cells are split and evaluated
/// again.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace tagfield {

class PlaneInReach;

/// Number of points processed together.
inline constexpr int kTile = 64;
using Tile = Eigen::Array<float, kTile, 1>;

/// Values of `of(x, y, z)` at each point, a tile at a time.
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

/// A cell is split into this many by this many.
inline constexpr int kGridSplit = 3;

/// The coarsest grid: a square of cells.
struct Grid {
  Eigen::Vector2d middle;  ///< [m]
  double cell_m = 0.25;
  double reach_m = 12.0;  ///< From the middle to an edge.
};

/// Brightness at the points (x, y) of a tile, relative to the grid's middle [m].
using GridLevel = std::function<Tile(const Tile& x, const Tile& y)>;

/// Side of a block of cells of the coarsest grid that a glance evaluates together.
inline constexpr int kBlock = 16;

/// A square of such cells.
struct CellBlock {
  float x = 0.0f, y = 0.0f;  ///< Middle of its first cell, relative to the grid's middle [m].
  float cell_m = 0.0f;
};

/// Brightness of a block: element (i, j) is that of the cell (x + i · cell_m, y + j · cell_m).
using BlockLight = Eigen::Array<float, kBlock, kBlock>;

/// Preselection of cells of the coarsest grid, cheaper than its level.
struct GridPreselection {
  /// Approximate brightness of a block's cells; empty for no glances.
  std::function<BlockLight(const CellBlock& block)> at_blocks;
  GridLevel at_cells{};  ///< Second glance at the remaining cells, with other reads; may be empty.
};

/// The cells of a block, a tile at a time.
BlockLight light_of_block(const GridLevel& brightness, const CellBlock& block);

struct GridMaximum {
  Eigen::Vector2d p;  ///< [m]
  float brightness = 0.0f;
};

/// At most `count` of the brightest local maxima on the finest grid, at least 5 cm apart, brightest
/// first; none if no cell is in reach. The first level evaluates the cells in reach, each further
/// one cells a third as wide where the previous level was bright. `levels` must not be empty. Each
/// glance keeps about the brightest tenth of the cells, the second at least 250.
std::vector<GridMaximum> search_grid(const Grid& grid, const PlaneInReach& in_reach,
                                     const std::vector<GridLevel>& levels, std::size_t count,
                                     const GridPreselection& glances = {});

}  // namespace tagfield
