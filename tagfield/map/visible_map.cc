// SPDX-License-Identifier: Apache-2.0
#include "tagfield/map/visible_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/base/trigonometry.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr double kLookoutSpacing_m = 0.4;
constexpr int kDirections = 720;

/// Cells that the robot's centre can reach from `start`.
std::vector<bool> reachable_cells(const OccupancyGrid& truth, const Eigen::Vector2i& start,
                                  double radius_m) {
  std::vector<bool> occupied;
  occupied.reserve(truth.cells.size());
  for (const std::int8_t cell : truth.cells) occupied.push_back(is_occupied(cell));
  const std::vector<float> clear =
      distance_field(truth, occupied, radius_m + 2.0 * truth.resolution_m);
  const auto fits = [&](int x, int y) {
    return is_free(truth.at(x, y)) && clear[truth.index(x, y)] >= static_cast<float>(radius_m);
  };
  if (!fits(start.x(), start.y())) {
    throw Error(fmt::format("a robot of radius {} m does not fit where it starts", radius_m));
  }
  std::vector<bool> reached(truth.cells.size(), false);
  reached[truth.index(start.x(), start.y())] = true;
  std::vector<Eigen::Vector2i> open{start};
  while (!open.empty()) {
    const Eigen::Vector2i cell = open.back();
    open.pop_back();
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const int x = cell.x() + dx;
      const int y = cell.y() + dy;
      if (!fits(x, y) || reached[truth.index(x, y)]) continue;
      reached[truth.index(x, y)] = true;
      open.emplace_back(x, y);
    }
  }
  return reached;
}

/// Cells along a ray from the middle of a cell, sampled every half cell: index offsets in a grid of
/// width `width`, each once. This misses corners at most.
std::vector<std::ptrdiff_t> steps_along(double angle, int width, int count) {
  const Eigen::Vector2d direction(cosine(angle), sine(angle));
  std::vector<std::ptrdiff_t> steps;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d at = Eigen::Vector2d::Constant(0.5) + 0.5 * i * direction;
    const std::ptrdiff_t step = static_cast<std::ptrdiff_t>(std::floor(at.y())) * width +
                                static_cast<std::ptrdiff_t>(std::floor(at.x()));
    if (steps.empty() || steps.back() != step) steps.push_back(step);
  }
  return steps;
}

/// Free cells of the grid with a rim of cells that are not free: 2 cells wider and higher.
std::vector<char> free_within_rim(const OccupancyGrid& grid) {
  const std::size_t width = static_cast<std::size_t>(grid.width) + 2;
  std::vector<char> all(width * (static_cast<std::size_t>(grid.height) + 2), 0);
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      all[(static_cast<std::size_t>(y) + 1) * width + static_cast<std::size_t>(x) + 1] =
          is_free(grid.at(x, y)) ? 1 : 0;
    }
  }
  return all;
}

/// Indices in free_within_rim() of the viewpoints.
std::vector<std::size_t> lookouts(const OccupancyGrid& truth, const std::vector<bool>& reached) {
  const int step =
      std::max(1, static_cast<int>(std::lround(kLookoutSpacing_m / truth.resolution_m)));
  const std::size_t width = static_cast<std::size_t>(truth.width) + 2;
  std::vector<std::size_t> all;
  for (int y = 0; y < truth.height; y += step) {
    for (int x = 0; x < truth.width; x += step) {
      if (!reached[truth.index(x, y)]) continue;
      all.push_back((static_cast<std::size_t>(y) + 1) * width + static_cast<std::size_t>(x) + 1);
    }
  }
  return all;
}

/// Marks the free cells along all rays, up to the first that is not free. Ordered by direction, as
/// rays in one direction take the same steps.
std::vector<char> seen_cells(const OccupancyGrid& truth, const std::vector<bool>& reached) {
  const std::vector<char> is_open = free_within_rim(truth);
  const std::vector<std::size_t> from = lookouts(truth, reached);
  std::vector<char> marked(is_open.size(), 0);
  const int width = truth.width + 2;
  // Half a cell at 45° advances 0.35 columns and rows: after `count` steps, a ray has left the
  // grid.
  const int count = 3 * (std::max(truth.width, truth.height) + 1);
  for (int i = 0; i < kDirections; ++i) {
    const std::vector<std::ptrdiff_t> steps = steps_along(i * kTwoPi / kDirections, width, count);
    for (const std::size_t place : from) {
      for (const std::ptrdiff_t step : steps) {
        const auto at = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(place) + step);
        if (is_open[at] == 0) break;
        marked[at] = 1;
      }
    }
  }
  std::vector<char> seen;
  seen.reserve(truth.cells.size());
  for (int y = 1; y <= truth.height; ++y) {
    const auto row = marked.begin() + static_cast<std::ptrdiff_t>(y) * width + 1;
    seen.insert(seen.end(), row, row + truth.width);
  }
  return seen;
}

bool borders_on(const OccupancyGrid& truth, const std::vector<char>& seen, int x, int y) {
  for (int v = y - 1; v <= y + 1; ++v) {
    for (int u = x - 1; u <= x + 1; ++u) {
      if (truth.contains(u, v) && seen[truth.index(u, v)] != 0) return true;
    }
  }
  return false;
}

}  // namespace

OccupancyGrid visible_map(const OccupancyGrid& truth, const Eigen::Vector2d& start,
                          double radius_m) {
  const std::vector<char> seen =
      seen_cells(truth, reachable_cells(truth, truth.cell_of(start), radius_m));
  OccupancyGrid visible = truth;
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      const std::size_t at = truth.index(x, y);
      const bool kept =
          is_occupied(truth.cells[at]) ? borders_on(truth, seen, x, y) : seen[at] != 0;
      if (!kept) visible.cells[at] = -1;
    }
  }
  return visible;
}

}  // namespace tagfield
