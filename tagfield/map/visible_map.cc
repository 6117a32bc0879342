// SPDX-License-Identifier: Apache-2.0
#include "tagfield/map/visible_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/base/trigonometry.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr double kLookoutSpacing_m = 0.4;
constexpr int kDirections = 720;

/// Cells where the robot's middle can be, from `start` on.
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

/// As std::floor(), of what is not below −1.
int cell_at(double place) { return place < 0.0 ? -1 : static_cast<int>(place); }

/// Marks the free cells along a ray, up to the first that is not free.
void look(const OccupancyGrid& truth, int x, int y, const Eigen::Vector2d& direction,
          std::vector<char>& seen) {
  // Half a cell a step misses no more than a corner, and leaves the map by less than a cell.
  for (double way = 0.0;; way += 0.5) {
    const int u = cell_at(x + 0.5 + way * direction.x());
    const int v = cell_at(y + 0.5 + way * direction.y());
    if (!is_free(truth.at(u, v))) return;
    seen[truth.index(u, v)] = 1;
  }
}

std::vector<Eigen::Vector2d> directions() {
  std::vector<Eigen::Vector2d> all;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = i * kTwoPi / kDirections;
    all.emplace_back(cosine(angle), sine(angle));
  }
  return all;
}

std::vector<char> seen_cells(const OccupancyGrid& truth, const std::vector<bool>& reached) {
  std::vector<char> seen(truth.cells.size(), 0);
  const std::vector<Eigen::Vector2d> around = directions();
  const int step =
      std::max(1, static_cast<int>(std::lround(kLookoutSpacing_m / truth.resolution_m)));
  for (int y = 0; y < truth.height; y += step) {
    for (int x = 0; x < truth.width; x += step) {
      if (!reached[truth.index(x, y)]) continue;
      for (const Eigen::Vector2d& direction : around) look(truth, x, y, direction, seen);
    }
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
