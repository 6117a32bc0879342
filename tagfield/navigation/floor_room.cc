// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/floor_room.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tagfield/navigation/near_distances.h"

namespace tagfield {
namespace {

constexpr std::int8_t kFreeCell = 0;
constexpr std::int8_t kOccupiedCell = 100;
constexpr std::int8_t kUnknownCell = -1;

/// Calls `visit(x, y)` for each cell of the grid whose centre is within `reach_m` of `p`.
template <typename Visit>
void around(const OccupancyGrid& grid, const Eigen::Vector2d& p, double reach_m, Visit visit) {
  const Eigen::Vector2d reach(reach_m, reach_m);
  const Eigen::Vector2i low = grid.cell_of(p - reach).cwiseMax(0);
  const Eigen::Vector2i high =
      grid.cell_of(p + reach).cwiseMin(Eigen::Vector2i(grid.width - 1, grid.height - 1));
  for (int y = low.y(); y <= high.y(); ++y) {
    for (int x = low.x(); x <= high.x(); ++x) {
      if ((grid.centre_of(x, y) - p).squaredNorm() <= reach_m * reach_m) visit(x, y);
    }
  }
}

int unknown_neighbours(const std::vector<std::int8_t>& cells, std::size_t i, std::size_t width) {
  int count = 0;
  for (const std::size_t row : {i - width, i, i + width}) {
    for (std::size_t j = row - 1; j <= row + 1; ++j) count += cells[j] == kFreeCell ? 0 : 1;
  }
  return count - 1;
}

/// Distance of each cell from occupied ones beyond the required minimum [m], up to slightly more
/// than the clearance.
std::vector<float> rooms(const OccupancyGrid& grid, const RobotRoom& size) {
  std::vector<std::uint8_t> sources(grid.cells.size());
  std::transform(grid.cells.begin(), grid.cells.end(), sources.begin(),
                 [](std::int8_t cell) { return std::uint8_t{cell == kOccupiedCell}; });
  const double max_m = size.min_m() + size.clearance_m;
  std::vector<float> room =
      near_distances(sources, grid.width, cells_for(max_m, grid.resolution_m));
  const auto least = static_cast<float>(size.min_m());
  for (float& distance : room) {
    distance = distance * static_cast<float>(grid.resolution_m) - least;
  }
  return room;
}

bool borders_on_free(const OccupancyGrid& grid, int x, int y) {
  return grid.at(x - 1, y) == kFreeCell || grid.at(x + 1, y) == kFreeCell ||
         grid.at(x, y - 1) == kFreeCell || grid.at(x, y + 1) == kFreeCell;
}

/// Lowers the distances next to unknown space, so that they are below 0 nearer than `min_m` to
/// it. Starts from the cells at its edge, as these are few.
void keep_from_unknown(const OccupancyGrid& grid, double min_m, std::vector<float>& room) {
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      if (grid.cells[grid.index(x, y)] != kUnknownCell || !borders_on_free(grid, x, y)) continue;
      const Eigen::Vector2d centre = grid.centre_of(x, y);
      around(grid, centre, min_m, [&](int i, int j) {
        const double distance = (grid.centre_of(i, j) - centre).norm();
        float& here = room[grid.index(i, j)];
        here = std::min(here, static_cast<float>(distance - min_m));
      });
    }
  }
}

std::uint8_t weight_of(float room_m, double clearance_m) {
  if (room_m < 0.0F) return 0;
  const double lack = clearance_m > 0.0 ? std::max(0.0, 1.0 - room_m / clearance_m) : 0.0;
  return static_cast<std::uint8_t>(
      std::lround(FloorRoom::kFar + (FloorRoom::kNear - FloorRoom::kFar) * lack * lack));
}

void stand(OccupancyGrid& grid, const Eigen::Vector2d& robot, double radius_m) {
  around(grid, robot, radius_m, [&](int x, int y) {
    std::int8_t& cell = grid.cells[grid.index(x, y)];
    if (cell == kUnknownCell) cell = kFreeCell;
  });
}

void let_out(FloorRoom& floor, const std::vector<float>& room, const Eigen::Vector2d& robot,
             double reach_m) {
  const Eigen::Vector2i cell = floor.grid.cell_of(robot);
  if (!floor.grid.contains(cell.x(), cell.y())) return;
  const float here = room[floor.grid.index(cell.x(), cell.y())];
  if (here >= 0.0F) return;
  around(floor.grid, robot, reach_m, [&](int x, int y) {
    const std::size_t i = floor.grid.index(x, y);
    if (floor.grid.cells[i] == kFreeCell && room[i] < 0.0F && room[i] >= here) {
      floor.weights[i] = FloorRoom::kOut;
    }
  });
}

}  // namespace

OccupancyGrid without_specks(const OccupancyGrid& map) {
  OccupancyGrid grid = map;
  for (std::int8_t& cell : grid.cells) {
    cell = is_occupied(cell) ? kOccupiedCell : is_free(cell) ? kFreeCell : kUnknownCell;
  }
  const std::vector<std::int8_t> before = grid.cells;
  const auto width = static_cast<std::size_t>(grid.width);
  for (int y = 1; y + 1 < grid.height; ++y) {
    for (int x = 1; x + 1 < grid.width; ++x) {
      const std::size_t i = grid.index(x, y);
      // A cell at a straight edge of unknown space has five neighbours that are not free.
      if (before[i] == kUnknownCell && unknown_neighbours(before, i, width) < 4) {
        grid.cells[i] = kFreeCell;
      }
    }
  }
  return grid;
}

FloorRoom floor_room(const OccupancyGrid& map, const std::vector<Eigen::Vector2d>& seen,
                     const std::optional<Eigen::Vector2d>& robot, const RobotRoom& size) {
  FloorRoom floor{without_specks(map), {}};
  OccupancyGrid& grid = floor.grid;
  for (const Eigen::Vector2d& point : seen) {
    const Eigen::Vector2i cell = grid.cell_of(point);
    if (grid.contains(cell.x(), cell.y())) {
      grid.cells[grid.index(cell.x(), cell.y())] = kOccupiedCell;
    }
  }
  if (robot) stand(grid, *robot, size.radius_m);
  std::vector<float> room = rooms(grid, size);
  keep_from_unknown(grid, kUnknownShare * size.radius_m, room);
  floor.weights.resize(room.size());
  std::transform(room.begin(), room.end(), grid.cells.begin(), floor.weights.begin(),
                 [&](float room_m, std::int8_t cell) {
                   return cell == kFreeCell ? weight_of(room_m, size.clearance_m) : std::uint8_t{0};
                 });
  if (robot) let_out(floor, room, *robot, 2.0 * size.min_m());
  return floor;
}

double distance_to_occupied(const OccupancyGrid& map, const Eigen::Vector2d& p, double max_m) {
  double nearest = max_m;
  const double half = 0.5 * map.resolution_m;
  around(map, p, max_m + map.resolution_m, [&](int x, int y) {
    if (!is_occupied(map.cells[map.index(x, y)])) return;
    const Eigen::Vector2d away =
        ((map.centre_of(x, y) - p).cwiseAbs() - Eigen::Vector2d(half, half)).cwiseMax(0.0);
    nearest = std::min(nearest, away.norm());
  });
  return nearest;
}

}  // namespace tagfield
