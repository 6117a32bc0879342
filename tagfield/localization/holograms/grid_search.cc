// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/grid_search.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "tagfield/localization/holograms/reach.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxKept = 250;  ///< Maximum number of cells of a level that are split.
constexpr std::size_t kFewestKept = 100;
constexpr float kBrightEnough = 0.6f;  ///< Of the brightest.
constexpr double kBoxesApart = 0.05;   ///< Maxima closer than this are the same [m].

struct SearchCell {
  std::int32_t i = 0, j = 0;
  float brightness = 0.0f;
};

/// Cells of a level: the middle of cell (i, j) is at (i, j) · size.
using Cells = std::vector<SearchCell>;

/// First cell of a block of the coarsest grid.
struct BlockBegin {
  std::int32_t i = 0, j = 0;
};

Eigen::Vector2d place_of(double size, double i, double j) { return size * Eigen::Vector2d(i, j); }

/// The coarsest grid, traversed in blocks.
class BlockGrid {
 public:
  BlockGrid(const Grid& grid, const PlaneInReach& in_reach)
      : grid_(grid),
        in_reach_(in_reach),
        end_(static_cast<std::int32_t>(grid.reach_m / grid.cell_m) + 2) {}

  using Around = PlaneInReach::Surrounding;

  /// Calls `take(begin, around)` for each block that is at least partly in reach.
  template <class Take>
  void for_each_block(const Take& take) const {
    constexpr double kToMiddle = 0.5 * (kBlock - 1);
    const double radius = kToMiddle * std::sqrt(2.0) * grid_.cell_m;
    for (BlockBegin at{1 - end_, 0}; at.i < end_; at.i += kBlock) {
      for (at.j = 1 - end_; at.j < end_; at.j += kBlock) {
        const Around around = in_reach_.around(
            grid_.middle + place_of(grid_.cell_m, at.i + kToMiddle, at.j + kToMiddle), radius);
        if (around.part != PlaneInReach::Part::kNone) take(at, around);
      }
    }
  }

  /// Calls `take(i, j)` for each cell of a block that is in reach, counted from the block's first.
  template <class Take>
  void for_each_cell(const BlockBegin& at, const Around& around, const Take& take) const {
    for (std::int32_t j = 0; j < std::min(kBlock, end_ - at.j); ++j) {
      for (std::int32_t i = 0; i < std::min(kBlock, end_ - at.i); ++i) {
        const bool is_in =
            around.part == PlaneInReach::Part::kAll ||
            in_reach_.holds(around, grid_.middle + place_of(grid_.cell_m, at.i + i, at.j + j));
        if (is_in) take(i, j);
      }
    }
  }

 private:
  const Grid& grid_;
  const PlaneInReach& in_reach_;
  std::int32_t end_;  ///< One past the last cell, along both axes.
};

Cells all_cells(const BlockGrid& grid) {
  Cells all;
  grid.for_each_block([&](const BlockBegin& at, const BlockGrid::Around& around) {
    grid.for_each_cell(at, around, [&](std::int32_t i, std::int32_t j) {
      all.push_back({at.i + i, at.j + j, 0.0f});
    });
  });
  return all;
}

constexpr std::size_t kOneOf = 10;  ///< A glance keeps one cell in ten.
constexpr float kOutOfReach = std::numeric_limits<float>::lowest();  ///< A cell's brightness.

struct PreselectedBlock {
  BlockBegin at;
  BlockLight light;
};

std::vector<PreselectedBlock> glanced_at(const BlockGrid& grid, double cell_m,
                                         const GridPreselection& glances) {
  std::vector<PreselectedBlock> blocks;
  grid.for_each_block([&](const BlockBegin& at, const BlockGrid::Around& around) {
    const Eigen::Vector2d first = place_of(cell_m, at.i, at.j);
    const BlockLight light = glances.at_blocks(
        {static_cast<float>(first.x()), static_cast<float>(first.y()), static_cast<float>(cell_m)});
    blocks.push_back({at, BlockLight::Constant(kOutOfReach)});
    BlockLight& in_reach = blocks.back().light;
    grid.for_each_cell(at, around,
                       [&](std::int32_t i, std::int32_t j) { in_reach(i, j) = light(i, j); });
  });
  return blocks;
}

/// Brightness that about a tenth of the cells exceed, from a histogram.
float light_of_tenth(const std::vector<PreselectedBlock>& blocks) {
  constexpr std::size_t kBins = 4096;
  float most = 0.0f;
  for (const PreselectedBlock& block : blocks) most = std::max(most, block.light.maxCoeff());
  if (!(most > 0.0f)) return std::nextafter(kOutOfReach, 0.0f);  // All that are in reach.
  const float bins_each = static_cast<float>(kBins - 1) / most;
  std::vector<std::uint32_t> counts(kBins, 0);
  std::size_t cells = 0;
  for (const PreselectedBlock& block : blocks) {
    for (const float light : block.light.reshaped()) {
      if (light == kOutOfReach) continue;
      ++counts[static_cast<std::size_t>(bins_each * std::max(light, 0.0f))];
      ++cells;
    }
  }
  std::size_t bin = kBins;
  for (std::size_t above = 0; bin > 0 && kOneOf * above < cells;) above += counts[--bin];
  return static_cast<float>(bin) / bins_each;
}

/// Approximately the brightest tenth of the cells, from the first glance.
Cells bright_cells(const BlockGrid& grid, double cell_m, const GridPreselection& glances) {
  const std::vector<PreselectedBlock> blocks = glanced_at(grid, cell_m, glances);
  const float least = light_of_tenth(blocks);
  Cells bright;
  for (const PreselectedBlock& block : blocks) {
    for (std::int32_t j = 0; j < kBlock; ++j) {
      for (std::int32_t i = 0; i < kBlock; ++i) {
        const float light = block.light(i, j);
        if (light >= least) bright.push_back({block.at.i + i, block.at.j + j, light});
      }
    }
  }
  return bright;
}

void illuminate(const GridLevel& brightness, double size, Cells& cells) {
  for (std::size_t begin = 0; begin < cells.size(); begin += kTile) {
    const std::size_t count = std::min<std::size_t>(kTile, cells.size() - begin);
    Tile x = Tile::Zero();
    Tile y = Tile::Zero();
    for (std::size_t k = 0; k < count; ++k) {
      x[static_cast<Eigen::Index>(k)] =
          static_cast<float>(size * static_cast<double>(cells[begin + k].i));
      y[static_cast<Eigen::Index>(k)] =
          static_cast<float>(size * static_cast<double>(cells[begin + k].j));
    }
    const Tile light = brightness(x, y);
    for (std::size_t k = 0; k < count; ++k) {
      cells[begin + k].brightness = light[static_cast<Eigen::Index>(k)];
    }
  }
}

/// Descending by brightness, then by index, so that the order is the same on every machine.
bool is_brighter(const SearchCell& a, const SearchCell& b) {
  if (a.brightness != b.brightness) return a.brightness > b.brightness;
  return a.i != b.i ? a.i < b.i : a.j < b.j;
}

/// Keeps the brightest tenth, but not fewer cells than are split.
void keep_brightest(Cells& cells) {
  const std::size_t left = std::max((cells.size() + kOneOf - 1) / kOneOf, kMaxKept);
  if (left >= cells.size()) return;
  const auto end = cells.begin() + static_cast<std::ptrdiff_t>(left);
  std::nth_element(cells.begin(), end, cells.end(), is_brighter);
  cells.erase(end, cells.end());
}

/// Cells of the coarsest grid that its level evaluates.
Cells first_cells(const Grid& grid, const PlaneInReach& in_reach, const GridPreselection& glances) {
  const BlockGrid blocks(grid, in_reach);
  if (!glances.at_blocks) return all_cells(blocks);
  Cells cells = bright_cells(blocks, grid.cell_m, glances);
  if (!glances.at_cells) return cells;
  illuminate(glances.at_cells, grid.cell_m, cells);
  keep_brightest(cells);
  return cells;
}

/// The bright cells, each split.
Cells split(Cells cells) {
  const std::size_t most = std::min(cells.size(), kMaxKept);
  std::partial_sort(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(most), cells.end(),
                    is_brighter);
  Cells finer;
  for (std::size_t k = 0; k < most; ++k) {
    const SearchCell& cell = cells[k];
    if (k >= kFewestKept && cell.brightness < kBrightEnough * cells.front().brightness) break;
    for (std::int32_t a = -1; a <= 1; ++a) {
      for (std::int32_t b = -1; b <= 1; ++b) {
        finer.push_back({kGridSplit * cell.i + a, kGridSplit * cell.j + b, 0.0f});
      }
    }
  }
  return finer;
}

std::uint64_t key_of(std::int32_t i, std::int32_t j) {
  return (static_cast<std::uint64_t>(i) << 32U) ^ static_cast<std::uint32_t>(j);
}

/// Cells as bright as all of their neighbours, brightest first.
Cells local_maxima(const Cells& cells) {
  std::unordered_map<std::uint64_t, float> light;
  light.reserve(cells.size());
  for (const SearchCell& cell : cells) light[key_of(cell.i, cell.j)] = cell.brightness;
  Cells maxima;
  for (const SearchCell& cell : cells) {
    bool highest = true;
    for (std::int32_t a = -1; a <= 1 && highest; ++a) {
      for (std::int32_t b = -1; b <= 1 && highest; ++b) {
        const auto neighbour = light.find(key_of(cell.i + a, cell.j + b));
        highest = neighbour == light.end() || neighbour->second <= cell.brightness;
      }
    }
    if (highest) maxima.push_back(cell);
  }
  std::sort(maxima.begin(), maxima.end(), is_brighter);
  return maxima;
}

std::vector<GridMaximum> apart(const Cells& maxima, double size, const Eigen::Vector2d& middle,
                               std::size_t count) {
  std::vector<GridMaximum> kept;
  for (const SearchCell& cell : maxima) {
    const Eigen::Vector2d p =
        middle + size * Eigen::Vector2d(static_cast<double>(cell.i), static_cast<double>(cell.j));
    const bool is_apart = std::all_of(kept.begin(), kept.end(), [&](const GridMaximum& other) {
      return (p - other.p).norm() > kBoxesApart;
    });
    if (is_apart) kept.push_back({p, cell.brightness});
    if (kept.size() == count) break;
  }
  return kept;
}

}  // namespace

BlockLight light_of_block(const GridLevel& brightness, const CellBlock& block) {
  constexpr Eigen::Index kColumns = kTile / kBlock;
  static_assert(kTile % kBlock == 0 && kBlock % kColumns == 0);
  BlockLight light;
  for (Eigen::Index j = 0; j < kBlock; j += kColumns) {
    Tile x;
    Tile y;
    for (Eigen::Index k = 0; k < kTile; ++k) {
      const Eigen::Index row = j + k / kBlock;
      x[k] = block.x + static_cast<float>(k % kBlock) * block.cell_m;
      y[k] = block.y + static_cast<float>(row) * block.cell_m;
    }
    light.middleCols<kColumns>(j).reshaped() = brightness(x, y);
  }
  return light;
}

std::vector<GridMaximum> search_grid(const Grid& grid, const PlaneInReach& in_reach,
                                     const std::vector<GridLevel>& levels, std::size_t count,
                                     const GridPreselection& glances) {
  Cells cells = first_cells(grid, in_reach, glances);
  double size = grid.cell_m;
  for (std::size_t level = 0; level + 1 < levels.size(); ++level) {
    illuminate(levels[level], size, cells);
    cells = split(std::move(cells));
    size /= kGridSplit;
  }
  illuminate(levels.back(), size, cells);
  return apart(local_maxima(cells), size, grid.middle, count);
}

}  // namespace tagfield
