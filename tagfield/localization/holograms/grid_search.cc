// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/grid_search.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <unordered_map>

namespace tagfield {
namespace {

constexpr std::size_t kMostKept = 250;  ///< Cells of a level that are split.
constexpr std::size_t kFewestKept = 100;
constexpr float kBrightEnough = 0.6f;  ///< Of the brightest.
constexpr double kBoxesApart = 0.05;   ///< Maxima nearer than this are one [m].

struct SearchCell {
  std::int64_t i = 0, j = 0;
  float brightness = 0.0f;
};

/// A level's grid: cell (i, j) has its middle at (i, j) · size.
using Cells = std::vector<SearchCell>;

Cells all_cells(const Grid& grid, const std::function<bool(const Eigen::Vector2d&)>& within) {
  Cells cells;
  const auto reach = static_cast<std::int64_t>(grid.reach_m / grid.cell_m) + 1;
  for (std::int64_t i = -reach; i <= reach; ++i) {
    for (std::int64_t j = -reach; j <= reach; ++j) {
      const Eigen::Vector2d p = grid.middle + grid.cell_m * Eigen::Vector2d(static_cast<double>(i),
                                                                            static_cast<double>(j));
      if (within(p)) cells.push_back({i, j, 0.0f});
    }
  }
  return cells;
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
    for (std::int64_t a = -1; a <= 1; ++a) {
      for (std::int64_t b = -1; b <= 1; ++b) {
        finer.push_back({kGridSplit * cell.i + a, kGridSplit * cell.j + b, 0.0f});
      }
    }
  }
  return finer;
}

std::uint64_t key_of(std::int64_t i, std::int64_t j) {
  return (static_cast<std::uint64_t>(i) << 32U) ^ (static_cast<std::uint64_t>(j) & 0xffffffffU);
}

/// Cells as bright as all of their neighbours, brightest first.
Cells local_maxima(const Cells& cells) {
  std::unordered_map<std::uint64_t, float> light;
  light.reserve(cells.size());
  for (const SearchCell& cell : cells) light[key_of(cell.i, cell.j)] = cell.brightness;
  Cells maxima;
  for (const SearchCell& cell : cells) {
    bool highest = true;
    for (std::int64_t a = -1; a <= 1 && highest; ++a) {
      for (std::int64_t b = -1; b <= 1 && highest; ++b) {
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

std::vector<GridMaximum> search_grid(const Grid& grid,
                                     const std::function<bool(const Eigen::Vector2d& p)>& within,
                                     const std::vector<GridLevel>& levels, std::size_t count,
                                     const GridLevel& glance) {
  Cells cells = all_cells(grid, within);
  double size = grid.cell_m;
  if (glance && !cells.empty()) {
    illuminate(glance, size, cells);
    keep_brightest(cells);
  }
  for (std::size_t level = 0; level + 1 < levels.size(); ++level) {
    illuminate(levels[level], size, cells);
    cells = split(std::move(cells));
    size /= kGridSplit;
  }
  illuminate(levels.back(), size, cells);
  return apart(local_maxima(cells), size, grid.middle, count);
}

}  // namespace tagfield
