// SPDX-License-Identifier: Apache-2.0
#include "tagfield/map/true_map.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/map/internal/cross_section.h"

namespace tagfield {
namespace {

constexpr std::int8_t kFree = 0;
constexpr std::int8_t kOccupied = 100;
constexpr std::int8_t kUnknown = -1;
constexpr double kMarginM = 1.0;
constexpr double kMaxCells = 4e8;
/// Share of a cell by which surfaces are shifted, so that one on a border between cells falls into
/// the greater one, whatever its rounding.
constexpr double kNudge = 1e-6;

void require(bool right, const char* what, double value) {
  if (!right) throw Error(fmt::format("true map: {}, is {}", what, value));
}

void check(const Eigen::Vector2d& start, double z_m, double resolution_m, double reach_m) {
  require(std::isfinite(z_m), "the height must be finite", z_m);
  require(start.cwiseAbs().maxCoeff() < 1e9 && start.allFinite(),
          "the start must be within 1e9 m of the origin", start.norm());
  require(resolution_m >= 1e-6 && resolution_m <= 1000.0,
          "the resolution must be greater than 0 and 1000 m at most", resolution_m);
  require(reach_m > 0.0 && reach_m <= 1e9, "the reach must be greater than 0 and 1e9 m at most",
          reach_m);
}

/// Grid around the segments and the start, with all cells unknown.
OccupancyGrid grid_around(const std::vector<Segment>& segments, const Eigen::Vector2d& start,
                          double resolution_m) {
  Eigen::AlignedBox2d box(start);
  for (const Segment& segment : segments) box.extend(segment.from).extend(segment.to);
  const Eigen::Array2d margin = Eigen::Array2d::Constant(kMarginM);
  const Eigen::Array2d low = ((box.min().array() - margin) / resolution_m).floor();
  const Eigen::Array2d high = ((box.max().array() + margin) / resolution_m).ceil();
  const Eigen::Array2d cells = high - low;
  require(cells.prod() <= kMaxCells, "expected at most 4e8 cells, wanted", cells.prod());
  OccupancyGrid grid;
  grid.resolution_m = resolution_m;
  grid.width = static_cast<int>(cells.x());
  grid.height = static_cast<int>(cells.y());
  grid.origin = resolution_m * low.matrix();
  grid.cells.assign(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height),
                    kUnknown);
  return grid;
}

/// Marks the cells that a segment passes through, each sharing a side with the next (Amanatides and
/// Woo, 1987), from the cell of its first end to that of its last.
void mark(const Segment& segment, OccupancyGrid& grid) {
  const Eigen::Array2d from = (segment.from - grid.origin).array() / grid.resolution_m + kNudge;
  const Eigen::Array2d to = (segment.to - grid.origin).array() / grid.resolution_m + kNudge;
  Eigen::Array2i cell = from.floor().cast<int>();
  const Eigen::Array2i last = to.floor().cast<int>();
  const Eigen::Array2i step = (last - cell).sign();
  const Eigen::Array2d along = to - from;
  // Fraction of the segment at which it leaves the cell along x or y.
  const auto leaves = [&](int axis) {
    if (cell[axis] == last[axis]) return 2.0;
    return (cell[axis] + (step[axis] > 0 ? 1 : 0) - from[axis]) / along[axis];
  };
  for (int left = (last - cell).abs().sum(); left >= 0; --left) {
    if (grid.contains(cell.x(), cell.y())) grid.cells[grid.index(cell.x(), cell.y())] = kOccupied;
    const int axis = leaves(0) < leaves(1) ? 0 : 1;
    cell[axis] += step[axis];
  }
}

/// Flood fill: frees unknown cells connected to `start` through sides of cells. Nothing beyond the
/// reach is freed, as surfaces there are not included.
void flood(const Eigen::Vector2d& start, double reach_m, OccupancyGrid& grid) {
  std::vector<Eigen::Vector2i> open{grid.cell_of(start)};
  grid.cells[grid.index(open[0].x(), open[0].y())] = kFree;
  while (!open.empty()) {
    const Eigen::Vector2i cell = open.back();
    open.pop_back();
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const Eigen::Vector2i next(cell.x() + dx, cell.y() + dy);
      if (!grid.contains(next.x(), next.y())) continue;
      std::int8_t& value = grid.cells[grid.index(next.x(), next.y())];
      const Eigen::Vector2d away = grid.centre_of(next.x(), next.y()) - start;
      if (value != kUnknown || away.cwiseAbs().maxCoeff() > reach_m) continue;
      value = kFree;
      open.push_back(next);
    }
  }
}

/// Whether `is` holds for any cell at most `reach` rows and columns away.
template <typename Predicate>
bool any_near(int x, int y, int reach, const Predicate& is) {
  for (int v = y - reach; v <= y + reach; ++v) {
    for (int u = x - reach; u <= x + reach; ++u) {
      if (is(u, v)) return true;
    }
  }
  return false;
}

void forget_hidden_surfaces(OccupancyGrid& grid) {
  const auto free_at = [&grid](int x, int y) { return grid.at(x, y) == kFree; };
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      std::int8_t& cell = grid.cells[grid.index(x, y)];
      if (cell == kOccupied && !any_near(x, y, 1, free_at)) cell = kUnknown;
    }
  }
}

/// The map aligned with the truth's cells: (x, y) are cell indices of the truth, possibly outside
/// it.
class LaidOver {
 public:
  LaidOver(const OccupancyGrid& map, const OccupancyGrid& truth)
      : map_(map),
        truth_(truth),
        offset_(((truth.origin - map.origin) / truth.resolution_m)
                    .array()
                    .round()
                    .max(-1e9)
                    .min(1e9)
                    .cast<int>()) {}

  [[nodiscard]] bool mapped(int x, int y) const { return is_occupied(map_at(x, y)); }
  [[nodiscard]] bool mapped_free(int x, int y) const { return is_free(map_at(x, y)); }
  [[nodiscard]] bool truly(int x, int y) const { return is_occupied(truth_.at(x, y)); }
  /// Whether the cell is mapped with no true one within two cells.
  [[nodiscard]] bool wrongly(int x, int y) const {
    return mapped(x, y) && !any_near(x, y, 2, [this](int u, int v) { return truly(u, v); });
  }
  [[nodiscard]] bool found(int x, int y) const {
    return any_near(x, y, 1, [this](int u, int v) { return mapped(u, v); });
  }
  /// A cell of the map, in the truth's indices.
  [[nodiscard]] Eigen::Vector2i of_map(int x, int y) const {
    return {x - offset_.x(), y - offset_.y()};
  }
  [[nodiscard]] bool has_double(int x, int y) const;

 private:
  [[nodiscard]] std::int8_t map_at(int x, int y) const {
    return map_.at(x + offset_.x(), y + offset_.y());
  }
  [[nodiscard]] bool free_between(int x, int y, int dx, int dy) const;

  const OccupancyGrid& map_;
  const OccupancyGrid& truth_;
  Eigen::Array2i offset_;  ///< The map's cell under the truth's cell (0, 0).
};

/// Whether the cells from (x, y) to (x + dx, y + dy), except the first two and the last, are free.
bool LaidOver::free_between(int x, int y, int dx, int dy) const {
  const int distance = std::max(std::abs(dx), std::abs(dy));
  for (int k = 2; k < distance; ++k) {
    const double share = static_cast<double>(k) / distance;
    const int u = x + static_cast<int>(std::lround(share * dx));
    const int v = y + static_cast<int>(std::lround(share * dy));
    if (!mapped_free(u, v)) return false;
  }
  return true;
}

bool LaidOver::has_double(int x, int y) const {
  constexpr int kNearest = 3;
  constexpr int kFurthest = 8;
  return any_near(x, y, kFurthest, [&](int u, int v) {
    const int dx = u - x;
    const int dy = v - y;
    if (std::max(std::abs(dx), std::abs(dy)) < kNearest) return false;
    return mapped(u, v) && free_between(x, y, dx, dy) && wrongly(u, v);
  });
}

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// Results that are counted over the truth's cells.
void compare_true_cells(const OccupancyGrid& truth, const LaidOver& both, MapComparison& result) {
  std::size_t found = 0;
  std::size_t doubled = 0;
  std::size_t truly_free = 0;
  std::size_t known = 0;
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      if (is_free(truth.at(x, y))) {
        ++truly_free;
        if (both.mapped_free(x, y)) ++known;
      }
      if (!both.truly(x, y)) continue;
      ++result.true_cells;
      if (!both.found(x, y)) continue;
      ++found;
      if (both.has_double(x, y)) ++doubled;
    }
  }
  result.found_share = share(found, result.true_cells);
  result.double_wall_share = share(doubled, result.true_cells);
  result.known_share = share(known, truly_free);
}

}  // namespace

OccupancyGrid true_map(const Scene& scene, double z_m, const Eigen::Vector2d& start,
                       double resolution_m, double reach_m) {
  check(start, z_m, resolution_m, reach_m);
  const std::vector<Segment> segments = cross_section(scene, z_m, {start, reach_m});
  OccupancyGrid grid = grid_around(segments, start, resolution_m);
  for (const Segment& segment : segments) mark(segment, grid);
  const Eigen::Vector2i first = grid.cell_of(start);
  if (grid.at(first.x(), first.y()) == kOccupied) {
    throw Error(fmt::format("true map: the start ({}, {}) is in a cell with a surface at {} m",
                            start.x(), start.y(), z_m));
  }
  flood(start, reach_m, grid);
  forget_hidden_surfaces(grid);
  return grid;
}

MapComparison compare_maps(const OccupancyGrid& map, const OccupancyGrid& truth) {
  if (!(std::abs(map.resolution_m - truth.resolution_m) <= 1e-9 * truth.resolution_m)) {
    throw Error(fmt::format("maps of {} m and {} m a cell can't be compared", map.resolution_m,
                            truth.resolution_m));
  }
  const LaidOver both(map, truth);
  MapComparison result;
  compare_true_cells(truth, both, result);
  std::size_t wrong = 0;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (!is_occupied(map.at(x, y))) continue;
      ++result.mapped_cells;
      const Eigen::Vector2i cell = both.of_map(x, y);
      if (both.wrongly(cell.x(), cell.y())) ++wrong;
    }
  }
  result.false_share = share(wrong, result.mapped_cells);
  return result;
}

}  // namespace tagfield
