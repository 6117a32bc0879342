// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/grid_search.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "tagfield/localization/holograms/reach.h"

namespace tagfield {
namespace {

constexpr std::size_t kMostKept = 250;  ///< Cells of a level that are split.
constexpr std::size_t kFewestKept = 100;
constexpr float kBrightEnough = 0.6f;  ///< Of the brightest.
constexpr double kBoxesApart = 0.05;   ///< Maxima nearer than this are one [m].

struct SearchCell {
  std::int32_t i = 0, j = 0;
  float brightness = 0.0f;
};

/// A level's grid: cell (i, j) has its middle at (i, j) · size.
using Cells = std::vector<SearchCell>;

/// The first cell of a block of the coarsest grid.
struct BlockBegin {
  std::int32_t i = 0, j = 0;
};

Eigen::Vector2d place_of(double size, double i, double j) { return size * Eigen::Vector2d(i, j); }

/// Calls `take(begin, cells)` for each block that has cells in reach, with those that are; `cells`
/// is used again.
template <class Take>
void for_each_block(const Grid& grid, const PlaneInReach& in_reach, const Take& take) {
  const auto reach = static_cast<std::int32_t>(grid.reach_m / grid.cell_m) + 1;
  constexpr double kToMiddle = 0.5 * (kBlock - 1);
  const double radius = kToMiddle * std::sqrt(2.0) * grid.cell_m;
  Cells cells;
  for (BlockBegin at{-reach, 0}; at.i <= reach; at.i += kBlock) {
    for (at.j = -reach; at.j <= reach; at.j += kBlock) {
      const auto part = in_reach.part_around(
          grid.middle + place_of(grid.cell_m, at.i + kToMiddle, at.j + kToMiddle), radius);
      if (part == PlaneInReach::Part::kNone) continue;
      cells.clear();
      for (std::int32_t j = at.j; j <= std::min(at.j + kBlock - 1, reach); ++j) {
        for (std::int32_t i = at.i; i <= std::min(at.i + kBlock - 1, reach); ++i) {
          const bool is_in = part == PlaneInReach::Part::kAll ||
                             in_reach.holds(grid.middle + place_of(grid.cell_m, i, j));
          if (is_in) cells.push_back({i, j, 0.0f});
        }
      }
      take(at, cells);
    }
  }
}

Cells all_cells(const Grid& grid, const PlaneInReach& in_reach) {
  Cells all;
  for_each_block(grid, in_reach, [&](const BlockBegin&, const Cells& cells) {
    all.insert(all.end(), cells.begin(), cells.end());
  });
  return all;
}

/// With what a glance tells of their brightness.
Cells glanced_at(const Grid& grid, const PlaneInReach& in_reach, const GridGlance& glance) {
  Cells all;
  for_each_block(grid, in_reach, [&](const BlockBegin& at, const Cells& cells) {
    if (cells.empty()) return;
    const Eigen::Vector2d first = place_of(grid.cell_m, at.i, at.j);
    const BlockLight light = glance({static_cast<float>(first.x()), static_cast<float>(first.y()),
                                     static_cast<float>(grid.cell_m)});
    for (const SearchCell& cell : cells) {
      all.push_back({cell.i, cell.j, light(cell.i - at.i, cell.j - at.j)});
    }
  });
  return all;
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

/// By falling brightness, then by place, so that the order is the same everywhere.
bool is_brighter(const SearchCell& a, const SearchCell& b) {
  if (a.brightness != b.brightness) return a.brightness > b.brightness;
  return a.i != b.i ? a.i < b.i : a.j < b.j;
}

/// The brightest tenth.
void keep_brightest(Cells& cells) {
  constexpr std::size_t kOneOf = 10;
  const auto end =
      cells.begin() + static_cast<std::ptrdiff_t>((cells.size() + kOneOf - 1) / kOneOf);
  std::nth_element(cells.begin(), end, cells.end(), is_brighter);
  cells.erase(end, cells.end());
}

/// The bright ones of the cells, each split.
Cells split(Cells cells) {
  const std::size_t most = std::min(cells.size(), kMostKept);
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

std::vector<GridMaximum> search_grid(const Grid& grid, const PlaneInReach& in_reach,
                                     const std::vector<GridLevel>& levels, std::size_t count,
                                     const GridGlance& glance) {
  Cells cells = glance ? glanced_at(grid, in_reach, glance) : all_cells(grid, in_reach);
  if (glance) keep_brightest(cells);
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
