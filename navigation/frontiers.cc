#include "navigation/frontiers.h"

#include <algorithm>
#include <cmath>

#include "navigation/floor_room.h"
#include "navigation/global_planner.h"
#include "navigation/grid_line.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

constexpr double kGivenUpReach = 0.5;
/// Metres of way that a metre of frontier is worth, and from which size on more is worth no more.
constexpr double kWayForSize = 1.0;
constexpr double kMostSize = 5.0;
/// The robot need not come nearer to a frontier than this to look into it.
constexpr double kNearEnough = 0.5;
constexpr std::size_t kCellsBetweenTries = 10;

using Cells = std::vector<Eigen::Vector2i>;

/// Free, and beside unknown ground along x or y.
bool is_frontier(const OccupancyGrid& grid, int x, int y) {
  if (grid.at(x, y) != 0) return false;
  const auto unknown = [&](int i, int j) { return grid.contains(i, j) && grid.at(i, j) < 0; };
  return unknown(x - 1, y) || unknown(x + 1, y) || unknown(x, y - 1) || unknown(x, y + 1);
}

/// The cells connected to the first of `cells`, which are taken out of `is_open`.
void grow(const OccupancyGrid& grid, std::vector<bool>& is_open, Cells& cells) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (int y = cells[i].y() - 1; y <= cells[i].y() + 1; ++y) {
      for (int x = cells[i].x() - 1; x <= cells[i].x() + 1; ++x) {
        if (!grid.contains(x, y) || !is_open[grid.index(x, y)]) continue;
        is_open[grid.index(x, y)] = false;
        cells.emplace_back(x, y);
      }
    }
  }
}

std::vector<Cells> connected_frontiers(const OccupancyGrid& grid) {
  std::vector<bool> is_open(grid.cells.size());
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) is_open[grid.index(x, y)] = is_frontier(grid, x, y);
  }
  std::vector<Cells> found;
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      if (!is_open[grid.index(x, y)]) continue;
      is_open[grid.index(x, y)] = false;
      found.push_back({{x, y}});
      grow(grid, is_open, found.back());
    }
  }
  return found;
}

/// The cell of `cells` nearest to their centroid.
Eigen::Vector2i middle_of(const Cells& cells) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2i& cell : cells) sum += cell.cast<double>();
  const Eigen::Vector2d centroid = sum / static_cast<double>(cells.size());
  return *std::min_element(cells.begin(), cells.end(), [&](const auto& a, const auto& b) {
    return (a.template cast<double>() - centroid).squaredNorm() <
           (b.template cast<double>() - centroid).squaredNorm();
  });
}

/// The unknown cell beside the frontier's cell `cell`.
Eigen::Vector2i unknown_beside(const OccupancyGrid& grid, const Eigen::Vector2i& cell) {
  for (const Eigen::Vector2i& step : {Eigen::Vector2i(1, 0), Eigen::Vector2i(-1, 0),
                                      Eigen::Vector2i(0, 1), Eigen::Vector2i(0, -1)}) {
    Eigen::Vector2i beside = cell + step;
    if (grid.contains(beside.x(), beside.y()) && grid.at(beside.x(), beside.y()) < 0) return beside;
  }
  return cell;
}

/// Whether on the line between two places all is free up to the first unknown cell.
bool can_see_unknown(const OccupancyGrid& grid, const Eigen::Vector2d& from,
                     const Eigen::Vector2d& to) {
  std::int8_t last = 0;
  along_line(grid, from, to, [&](int x, int y, double) {
    last = grid.at(x, y);
    return last == 0;
  });
  return last < 0;
}

/// What a search for a place to stand needs.
struct Reach {
  const FloorRoom& floor;
  const Spread& ways;  ///< From the robot.
  double least_m;      ///< From the robot's centre to obstacles.
  double sight_m;
};

/// The place that can be reached, sees into the unknown beside `target` and is nearest to
/// kNearEnough from it.
std::optional<Eigen::Vector2i> standing_place(const Reach& reach, const Eigen::Vector2i& target) {
  const OccupancyGrid& grid = reach.floor.grid;
  const Eigen::Vector2d target_M = grid.centre_of(target.x(), target.y());
  const Eigen::Vector2i unknown = unknown_beside(grid, target);
  const Eigen::Vector2d unknown_M = grid.centre_of(unknown.x(), unknown.y());
  const int most = static_cast<int>(reach.sight_m / grid.resolution_m);
  std::optional<Eigen::Vector2i> best;
  double best_excess = reach.sight_m;
  for (int ring = 0; ring <= most; ++ring) {
    // All cells of this ring and the next are at least so far off.
    if (best && ring * grid.resolution_m - kNearEnough > best_excess) break;
    for (int y = target.y() - ring; y <= target.y() + ring; ++y) {
      const bool is_edge = std::abs(y - target.y()) == ring;
      for (int x = target.x() - ring; x <= target.x() + ring; x += is_edge ? 1 : 2 * ring) {
        if (!grid.contains(x, y) || reach.ways.costs[grid.index(x, y)] < 0) continue;
        const Eigen::Vector2d place = grid.centre_of(x, y);
        const double excess = std::abs((place - target_M).norm() - kNearEnough);
        if (excess >= best_excess || !can_see_unknown(grid, place, unknown_M)) continue;
        // A goal is held to this exactly, not from cell to cell.
        if (distance_to_occupied(grid, place, reach.least_m) < reach.least_m) continue;
        best = Eigen::Vector2i(x, y);
        best_excess = excess;
      }
    }
  }
  return best;
}

double way_length(const FloorRoom& floor, const Spread& ways, const Eigen::Vector2i& cell) {
  const Cells way = way_back(floor, ways, cell);
  double length = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    length += (way[i] - way[i - 1]).cast<double>().norm() * floor.grid.resolution_m;
  }
  return length;
}

std::optional<Frontier> frontier_of(const Reach& reach, const Cells& cells,
                                    const std::vector<Eigen::Vector2d>& given_up) {
  const OccupancyGrid& grid = reach.floor.grid;
  Eigen::Vector2i target = middle_of(cells);
  std::optional<Eigen::Vector2i> place = standing_place(reach, target);
  // Where its middle can't be seen, a part of it may.
  for (std::size_t i = 0; i < cells.size() && !place; i += kCellsBetweenTries) {
    target = cells[i];
    place = standing_place(reach, target);
  }
  if (!place) return std::nullopt;
  const Eigen::Vector2d goal = grid.centre_of(place->x(), place->y());
  const Eigen::Vector2d look = grid.centre_of(target.x(), target.y()) - goal;
  for (const Eigen::Vector2d& point : given_up) {
    if ((point - goal).norm() < kGivenUpReach) return std::nullopt;
  }
  return Frontier{{goal.x(), goal.y(), std::atan2(look.y(), look.x())},
                  static_cast<double>(cells.size()) * grid.resolution_m,
                  way_length(reach.floor, reach.ways, *place)};
}

double dearness(const Frontier& frontier) {
  return frontier.way_m - kWayForSize * std::min(frontier.size_m, kMostSize);
}

}  // namespace

std::vector<Frontier> frontiers(const OccupancyGrid& map, const PlanarPose& pose_M,
                                const std::vector<Eigen::Vector2d>& given_up,
                                const FrontierOptions& options) {
  const RobotRoom size{options.radius_m, options.margin_m, 0.0};
  const Eigen::Vector2d robot = position_of(pose_M);
  const FloorRoom floor = floor_room(map, {}, robot, size);
  const Spread ways = spread(floor, floor.grid.cell_of(robot));
  std::vector<Frontier> found;
  for (const Cells& cells : connected_frontiers(floor.grid)) {
    if (static_cast<double>(cells.size()) * map.resolution_m < options.least_size_m) continue;
    const std::optional<Frontier> frontier =
        frontier_of({floor, ways, size.least_m(), options.sight_m}, cells, given_up);
    if (frontier) found.push_back(*frontier);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Frontier& a, const Frontier& b) { return dearness(a) < dearness(b); });
  return found;
}

}  // namespace tagfield
