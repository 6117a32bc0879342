#include "tagfield/map/visible_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tagfield/base/error.h"
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

/// Marks the free cells along a ray, up to the first that is not free.
void look(const OccupancyGrid& truth, int x, int y, double angle, std::vector<bool>& seen) {
  const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
  // Half a cell a step misses no more than a corner.
  for (double way = 0.0;; way += 0.5) {
    const int u = static_cast<int>(std::floor(x + 0.5 + way * direction.x()));
    const int v = static_cast<int>(std::floor(y + 0.5 + way * direction.y()));
    if (!is_free(truth.at(u, v))) return;
    seen[truth.index(u, v)] = true;
  }
}

std::vector<bool> seen_cells(const OccupancyGrid& truth, const std::vector<bool>& reached) {
  std::vector<bool> seen(truth.cells.size(), false);
  const int step =
      std::max(1, static_cast<int>(std::lround(kLookoutSpacing_m / truth.resolution_m)));
  for (int y = 0; y < truth.height; y += step) {
    for (int x = 0; x < truth.width; x += step) {
      if (!reached[truth.index(x, y)]) continue;
      for (int i = 0; i < kDirections; ++i) look(truth, x, y, i * kTwoPi / kDirections, seen);
    }
  }
  return seen;
}

bool borders_on(const OccupancyGrid& truth, const std::vector<bool>& seen, int x, int y) {
  for (int v = y - 1; v <= y + 1; ++v) {
    for (int u = x - 1; u <= x + 1; ++u) {
      if (truth.contains(u, v) && seen[truth.index(u, v)]) return true;
    }
  }
  return false;
}

}  // namespace

OccupancyGrid visible_map(const OccupancyGrid& truth, const Eigen::Vector2d& start,
                          double radius_m) {
  const std::vector<bool> seen =
      seen_cells(truth, reachable_cells(truth, truth.cell_of(start), radius_m));
  OccupancyGrid visible = truth;
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      const std::size_t at = truth.index(x, y);
      const bool kept = is_occupied(truth.cells[at]) ? borders_on(truth, seen, x, y) : seen[at];
      if (!kept) visible.cells[at] = -1;
    }
  }
  return visible;
}

}  // namespace tagfield
