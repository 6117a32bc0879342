// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/frontiers.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/error.h"
#include "tagfield/base/trigonometry.h"
#include "tagfield/base/units.h"
#include "tagfield/motion/planar_pose.h"
#include "tagfield/navigation/floor_room.h"
#include "tagfield/navigation/global_planner.h"
#include "tagfield/navigation/grid_line.h"

namespace tagfield {
namespace {

/// Looks are the same if their points are this near to each other, or if their viewpoints are this
/// near and their directions this similar.
constexpr double kSameView = 0.5;
constexpr double kSameDirection = 0.5;
/// Metres of path that a metre of frontier is worth, and the size above which more is worth
/// nothing.
constexpr double kWayForSize = 1.0;
constexpr double kMaxSize = 5.0;
/// The robot need not come nearer to a frontier than this to look into it.
constexpr double kNearEnough = 0.5;
/// Least sine of the viewing angle; smaller ones count as this.
constexpr double kMinSlant = 0.05;
constexpr std::size_t kCellsBetweenTries = 10;

using Cells = std::vector<Eigen::Vector2i>;

/// Whether a cell is free and has an unknown neighbour along x or y.
bool is_frontier(const OccupancyGrid& grid, int x, int y) {
  if (grid.at(x, y) != 0) return false;
  const auto unknown = [&](int i, int j) { return grid.contains(i, j) && grid.at(i, j) < 0; };
  return unknown(x - 1, y) || unknown(x + 1, y) || unknown(x, y - 1) || unknown(x, y + 1);
}

/// Grows `cells` by all cells connected to its first, and removes them from `is_open`.
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

/// An unknown cell next to the frontier cell `cell`.
Eigen::Vector2i unknown_beside(const OccupancyGrid& grid, const Eigen::Vector2i& cell) {
  for (const Eigen::Vector2i& step : {Eigen::Vector2i(1, 0), Eigen::Vector2i(-1, 0),
                                      Eigen::Vector2i(0, 1), Eigen::Vector2i(0, -1)}) {
    Eigen::Vector2i beside = cell + step;
    if (grid.contains(beside.x(), beside.y()) && grid.at(beside.x(), beside.y()) < 0) return beside;
  }
  return cell;
}

/// Whether the line between two points is free up to the first unknown cell.
bool can_see_unknown(const OccupancyGrid& grid, const Eigen::Vector2d& from,
                     const Eigen::Vector2d& to) {
  std::int8_t last = 0;
  along_line(grid, from, to, [&](int x, int y, double) {
    last = grid.at(x, y);
    return last == 0;
  });
  return last < 0;
}

/// Input of the search for a viewpoint.
struct Reach {
  const OccupancyGrid& seen;
  const FloorRoom& floor;
  const Spread& ways;  ///< From the robot.
  double min_m;        ///< From the robot's centre to obstacles.
  double sight_m;
};

/// Calls `visit(x, y)` for the free cells that see `unknown` in a straight line, some more than
/// once.
template <typename Visit>
void for_all_that_see(const OccupancyGrid& grid, const Eigen::Vector2i& unknown, double sight_m,
                      Visit visit) {
  // Neighbouring rays end a cell apart.
  const int rays = static_cast<int>(std::ceil(kTwoPi * sight_m / grid.resolution_m));
  const Eigen::Vector2d from = grid.centre_of(unknown.x(), unknown.y());
  for (int i = 0; i < rays; ++i) {
    const double angle = i * kTwoPi / rays;
    bool is_out = false;  // Of the unknown.
    along_line(grid, from, from + sight_m * Eigen::Vector2d(cosine(angle), sine(angle)),
               [&](int x, int y, double) {
                 if (!grid.contains(x, y)) return false;
                 const std::int8_t cell = grid.at(x, y);
                 if (cell < 0) return !is_out;
                 if (cell > 0) return false;
                 is_out = true;
                 visit(x, y);
                 return true;
               });
  }
}

/// Unit vector from known to unknown space at a frontier cell; 0 where that is ambiguous.
Eigen::Vector2d into_unknown(const OccupancyGrid& grid, const Eigen::Vector2i& cell) {
  constexpr int kReach = 3;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int y = -kReach; y <= kReach; ++y) {
    for (int x = -kReach; x <= kReach; ++x) {
      const bool is_unknown = grid.at(cell.x() + x, cell.y() + y) < 0;
      sum += (is_unknown ? 1.0 : -1.0) * Eigen::Vector2d(x, y);
    }
  }
  return sum.norm() > 0.0 ? sum.normalized().eval() : sum;
}

struct Place {
  double view;  ///< How well it sees the frontier.
  std::size_t cell;
};

bool is_worse(const Place& a, const Place& b) {
  return a.view < b.view || (a.view == b.view && a.cell > b.cell);
}

/// The reachable positions that see `unknown`, as a heap with the best at the front. The view
/// improves with the angle at which it looks in, and with proximity up to kNearEnough.
std::vector<Place> places_to_see(const Reach& reach, const Eigen::Vector2i& target,
                                 const Eigen::Vector2i& unknown) {
  const OccupancyGrid& grid = reach.seen;
  const Eigen::Vector2d target_M = grid.centre_of(target.x(), target.y());
  const Eigen::Vector2d normal = into_unknown(grid, target);
  std::vector<Place> places;
  for_all_that_see(grid, unknown, reach.sight_m, [&](int x, int y) {
    const std::size_t cell = grid.index(x, y);
    if (reach.ways.costs[cell] < 0) return;
    const Eigen::Vector2d way = target_M - grid.centre_of(x, y);
    const double slant = std::max(way.dot(normal) / (way.norm() + 1e-9), kMinSlant);
    places.push_back({slant / std::max(way.norm(), kNearEnough), cell});
  });
  std::make_heap(places.begin(), places.end(), is_worse);
  return places;
}

/// The best position from which to look into the unknown space next to `target`.
std::optional<Eigen::Vector2i> standing_place(const Reach& reach, const Eigen::Vector2i& target) {
  const OccupancyGrid& grid = reach.seen;
  const Eigen::Vector2i unknown = unknown_beside(grid, target);
  const Eigen::Vector2d unknown_M = grid.centre_of(unknown.x(), unknown.y());
  std::vector<Place> places = places_to_see(reach, target, unknown);
  std::optional<std::size_t> last;
  for (; !places.empty(); places.pop_back()) {
    std::pop_heap(places.begin(), places.end(), is_worse);
    if (places.back().cell == last) continue;  // Several rays may have passed here.
    last = places.back().cell;
    const auto at = static_cast<int>(*last);
    const Eigen::Vector2i cell(at % grid.width, at / grid.width);
    const Eigen::Vector2d place = grid.centre_of(cell.x(), cell.y());
    // A goal must meet this limit exactly, not just to within a cell.
    if (distance_to_occupied(reach.floor.grid, place, reach.min_m) < reach.min_m) continue;
    if (can_see_unknown(grid, place, unknown_M)) return cell;
  }
  return std::nullopt;
}

double way_length(const FloorRoom& floor, const Spread& ways, const Eigen::Vector2i& cell) {
  const Cells way = backtrack(floor, ways, cell);
  double length = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    length += (way[i] - way[i - 1]).cast<double>().norm() * floor.grid.resolution_m;
  }
  return length;
}

bool is_same(const Viewpoint& a, const Viewpoint& b) {
  const bool same_place = (position_of(a.from_M) - position_of(b.from_M)).norm() < kSameView;
  const double turned = std::abs(wrap_to_pi(a.from_M.yaw - b.from_M.yaw));
  return (a.at_M - b.at_M).norm() < kSameView || (same_place && turned < kSameDirection);
}

/// Viewpoint from which to look at the frontier cell `target`; none if that was done already.
std::optional<Viewpoint> new_look(const Reach& reach, const Eigen::Vector2i& target,
                                  const std::vector<Viewpoint>& looks) {
  const OccupancyGrid& grid = reach.seen;
  const Eigen::Vector2d at = grid.centre_of(target.x(), target.y());
  const auto was_there = [&](const Viewpoint& look) { return (look.at_M - at).norm() < kSameView; };
  if (std::any_of(looks.begin(), looks.end(), was_there)) return std::nullopt;
  const std::optional<Eigen::Vector2i> place = standing_place(reach, target);
  if (!place) return std::nullopt;
  const Eigen::Vector2d from = grid.centre_of(place->x(), place->y());
  const Viewpoint look{{from.x(), from.y(), arc_tangent(at.y() - from.y(), at.x() - from.x())}, at};
  const auto is_known = [&](const Viewpoint& other) { return is_same(look, other); };
  if (std::any_of(looks.begin(), looks.end(), is_known)) return std::nullopt;
  return look;
}

std::optional<Frontier> frontier_of(const Reach& reach, const Cells& cells,
                                    const std::vector<Viewpoint>& looks) {
  const OccupancyGrid& grid = reach.seen;
  std::optional<Viewpoint> look = new_look(reach, middle_of(cells), looks);
  // If its middle can't be seen, another part may be visible.
  for (std::size_t i = 0; i < cells.size() && !look; i += kCellsBetweenTries) {
    look = new_look(reach, cells[i], looks);
  }
  if (!look) return std::nullopt;
  return Frontier{*look, static_cast<double>(cells.size()) * grid.resolution_m,
                  way_length(reach.floor, reach.ways, grid.cell_of(position_of(look->from_M)))};
}

/// The floor that the robot stands on is free, seen or not.
OccupancyGrid with_ground_of(OccupancyGrid seen, const OccupancyGrid& floor) {
  for (std::size_t i = 0; i < seen.cells.size(); ++i) {
    if (seen.cells[i] < 0 && floor.cells[i] == 0) seen.cells[i] = 0;
  }
  return seen;
}

double dearness(const Frontier& frontier) {
  return frontier.way_m - kWayForSize * std::min(frontier.size_m, kMaxSize);
}

}  // namespace

bool has_frontier_near(const OccupancyGrid& map, const Eigen::Vector2d& p_M, double reach_m) {
  const Eigen::Vector2d reach(reach_m, reach_m);
  const Eigen::Vector2i low = map.cell_of(p_M - reach);
  const Eigen::Vector2i high = map.cell_of(p_M + reach);
  for (int y = low.y(); y <= high.y(); ++y) {
    for (int x = low.x(); x <= high.x(); ++x) {
      if (is_frontier(map, x, y)) return true;
    }
  }
  return false;
}

std::vector<Frontier> frontiers(const OccupancyGrid& map, const OccupancyGrid& drivable,
                                const PlanarPose& pose_M, const std::vector<Viewpoint>& looks,
                                const FrontierOptions& options) {
  if (map.width != drivable.width || map.height != drivable.height) {
    throw Error("a map and where to drive on it differ in size");
  }
  const RobotRoom size{options.radius_m, options.margin_m, 0.0};
  const Eigen::Vector2d robot = position_of(pose_M);
  const FloorRoom floor = floor_room(drivable, {}, robot, size);
  const OccupancyGrid seen = with_ground_of(without_specks(map), floor.grid);
  const Spread ways = spread(floor, floor.grid.cell_of(robot));
  std::vector<Frontier> found;
  for (const Cells& cells : connected_frontiers(seen)) {
    if (static_cast<double>(cells.size()) * map.resolution_m < options.min_size_m) continue;
    const std::optional<Frontier> frontier =
        frontier_of({seen, floor, ways, size.min_m(), options.sight_m}, cells, looks);
    if (frontier) found.push_back(*frontier);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Frontier& a, const Frontier& b) { return dearness(a) < dearness(b); });
  return found;
}

}  // namespace tagfield
