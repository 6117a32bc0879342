// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/global_planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tagfield/motion/planar_pose.h"
#include "tagfield/navigation/grid_line.h"

namespace tagfield {
namespace {

/// Neighbours, ordered such that k ^ 1 is opposite to k; the last four are diagonal.
struct Step {
  int x;
  int y;
  std::int32_t length;  ///< In twelfths of a cell: 17/12 is √2 to 0.2 %.
};
constexpr std::array<Step, 8> kSteps = {{{1, 0, 12},
                                         {-1, 0, 12},
                                         {0, 1, 12},
                                         {0, -1, 12},
                                         {1, 1, 17},
                                         {-1, -1, 17},
                                         {1, -1, 17},
                                         {-1, 1, 17}}};
constexpr double kTwelfths = 12.0;

/// Open cells, sorted by the estimated cost of the path through them: a bucket queue (Dial), since
/// a step adds a small integer to that cost.
class Waiting {
 public:
  struct Entry {
    std::int32_t cost;  ///< So far.
    int x;
    int y;
  };

  void add(const Entry& entry, std::int32_t promised) {
    buckets_[static_cast<std::size_t>(promised) % buckets_.size()].push_back(entry);
    ++count_;
  }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  /// Removes one of the cheapest. Must not be called when empty.
  Entry take() {
    while (buckets_[at_].empty()) at_ = (at_ + 1) % buckets_.size();
    const Entry entry = buckets_[at_].back();
    buckets_[at_].pop_back();
    --count_;
    return entry;
  }

 private:
  // More than a step can add: 17 twelfths at the greatest weight, and leading away at the least.
  std::array<std::vector<Entry>, 1024> buckets_;
  std::size_t at_ = 0;
  std::size_t count_ = 0;
};
static_assert(17 * (FloorRoom::kOut + FloorRoom::kFar) < 1024);

/// Lower bound on the cost of any path between two cells.
std::int32_t min_cost(int x, int y, const Eigen::Vector2i& to) {
  const int along = std::abs(x - to.x());
  const int across = std::abs(y - to.y());
  return FloorRoom::kFar * (12 * std::max(along, across) + 5 * std::min(along, across));
}

/// Whether a step over a corner squeezes between two cells that are not allowed.
bool cuts_corner(const FloorRoom& floor, int x, int y, const Step& step) {
  return step.x != 0 && step.y != 0 &&
         (floor.weight(x + step.x, y) == 0 || floor.weight(x, y + step.y) == 0);
}

/// Cost of the straight line, in the unit of Spread; none if it passes a cell that is not allowed.
std::optional<double> line_cost(const FloorRoom& floor, const Eigen::Vector2d& a,
                                const Eigen::Vector2d& b) {
  double cost = 0.0;
  const bool allowed = along_line(floor.grid, a, b, [&](int x, int y, double length_m) {
    const std::uint8_t weight = floor.weight(x, y);
    cost += weight * length_m;
    return weight != 0;
  });
  if (!allowed) return std::nullopt;
  return kTwelfths * cost / floor.grid.resolution_m;
}

/// The cell of nonzero weight nearest to `p` within two cells: if a goal is exactly at the least
/// distance from a wall, the centre of its own cell may be slightly nearer.
std::optional<Eigen::Vector2i> allowed_cell(const FloorRoom& floor, const Eigen::Vector2d& p) {
  const Eigen::Vector2i cell = floor.grid.cell_of(p);
  std::optional<Eigen::Vector2i> best;
  double nearest = 1e9;
  for (int y = cell.y() - 2; y <= cell.y() + 2; ++y) {
    for (int x = cell.x() - 2; x <= cell.x() + 2; ++x) {
      const double distance = (floor.grid.centre_of(x, y) - p).norm();
      if (floor.weight(x, y) == 0 || distance >= nearest) continue;
      nearest = distance;
      best = Eigen::Vector2i(x, y);
    }
  }
  return best;
}

std::string at(const char* what, const PlanarPose& pose) {
  return fmt::format("{} ({:.2f}, {:.2f})", what, pose.x, pose.y);
}

}  // namespace

Spread spread(const FloorRoom& floor, const Eigen::Vector2i& from,
              const std::optional<Eigen::Vector2i>& until) {
  const OccupancyGrid& grid = floor.grid;
  Spread result{std::vector<std::int32_t>(grid.cells.size(), Spread::kUnreached),
                std::vector<std::uint8_t>(grid.cells.size(), Spread::kNowhere)};
  if (floor.weight(from.x(), from.y()) == 0) return result;
  Waiting waiting;
  // With a target this is A*, otherwise Dijkstra's algorithm.
  const auto ahead = [&](int x, int y) { return until ? min_cost(x, y, *until) : 0; };
  result.costs[grid.index(from.x(), from.y())] = 0;
  waiting.add({0, from.x(), from.y()}, ahead(from.x(), from.y()));
  while (!waiting.empty()) {
    const auto [cost, x, y] = waiting.take();
    if (until && x == until->x() && y == until->y()) break;
    const std::size_t here = grid.index(x, y);
    if (cost > result.costs[here]) continue;
    for (std::size_t k = 0; k < kSteps.size(); ++k) {
      const Step& step = kSteps[k];
      const std::uint8_t weight = floor.weight(x + step.x, y + step.y);
      if (weight == 0 || cuts_corner(floor, x, y, step)) continue;
      const std::size_t there = grid.index(x + step.x, y + step.y);
      const std::int32_t total = cost + step.length * (floor.weights[here] + weight) / 2;
      if (result.costs[there] >= 0 && result.costs[there] <= total) continue;
      result.costs[there] = total;
      result.back[there] = static_cast<std::uint8_t>(k ^ 1U);
      waiting.add({total, x + step.x, y + step.y}, total + ahead(x + step.x, y + step.y));
    }
  }
  return result;
}

std::vector<Eigen::Vector2i> backtrack(const FloorRoom& floor, const Spread& spread,
                                       const Eigen::Vector2i& cell) {
  std::vector<Eigen::Vector2i> way = {cell};
  for (;;) {
    const std::uint8_t back = spread.back[floor.grid.index(way.back().x(), way.back().y())];
    if (back == Spread::kNowhere) return way;
    const Step& step = kSteps[back];
    way.emplace_back(way.back().x() + step.x, way.back().y() + step.y);
  }
}

std::vector<Eigen::Vector2d> straightened(const FloorRoom& floor,
                                          const std::vector<Eigen::Vector2d>& way) {
  if (way.empty()) return {};
  std::vector<Eigen::Vector2d> result = {way.front()};
  std::size_t from = 0;
  while (from + 1 < way.size()) {
    std::size_t to = from + 1;
    double steps_cost = line_cost(floor, way[from], way[to]).value_or(1e9);
    for (std::size_t next = to + 1; next < way.size(); ++next) {
      steps_cost += line_cost(floor, way[next - 1], way[next]).value_or(1e9);
      const std::optional<double> straight = line_cost(floor, way[from], way[next]);
      // Twice as many cells as it takes to see past an unlucky run of them.
      if (!straight && next > to + 4) break;
      if (straight && *straight <= 1.001 * steps_cost)
        to = next;
      else if (next > to + 20)
        break;
    }
    result.push_back(way[to]);
    from = to;
  }
  return result;
}

std::string fault_of(const OccupancyGrid& map, const PlanarPose& pose_M, const PlanarPose& goal_M,
                     const RobotRoom& size) {
  if (!is_finite(goal_M)) return "the goal is not finite";
  if (!is_finite(pose_M)) return "the robot's pose is not finite";
  const std::string goal = at("goal", goal_M);
  const Eigen::Vector2i cell = map.cell_of(position_of(goal_M));
  if (!map.contains(cell.x(), cell.y())) return goal + ": off the map";
  if (is_occupied(map.at(cell.x(), cell.y()))) return goal + ": on an obstacle";
  if (without_specks(map).at(cell.x(), cell.y()) != 0) return goal + ": on unknown ground";
  if (distance_to_occupied(map, position_of(goal_M), size.min_m()) < size.min_m()) {
    return fmt::format("{}: nearer than {:.2f} m to an obstacle", goal, size.min_m());
  }
  const std::string robot = at("the robot at", pose_M);
  const Eigen::Vector2i here = map.cell_of(position_of(pose_M));
  if (!map.contains(here.x(), here.y())) return robot + ": off the map";
  // Half the radius is well inside any footprint, and more than the errors of maps and poses.
  if (distance_to_occupied(map, position_of(pose_M), 0.5 * size.radius_m) < 0.5 * size.radius_m) {
    return robot + ": in an obstacle";
  }
  return "";
}

Plan plan(const OccupancyGrid& map, const std::vector<Eigen::Vector2d>& seen,
          const PlanarPose& pose_M, const PlanarPose& goal_M, const RobotRoom& size) {
  const std::string fault = fault_of(map, pose_M, goal_M, size);
  if (!fault.empty()) return {{}, fault};
  const Eigen::Vector2d start = position_of(pose_M);
  const Eigen::Vector2d end = position_of(goal_M);
  const FloorRoom floor = floor_room(map, seen, start, size);
  const std::optional<Eigen::Vector2i> from = allowed_cell(floor, start);
  const std::optional<Eigen::Vector2i> to = allowed_cell(floor, end);
  const std::string no_way = fmt::format("{}: no path there from ({:.2f}, {:.2f})",
                                         at("goal", goal_M), pose_M.x, pose_M.y);
  if (!from || !to) return {{}, no_way};
  const Spread ways = spread(floor, *to, from);
  if (ways.costs[floor.grid.index(from->x(), from->y())] < 0) return {{}, no_way};
  std::vector<Eigen::Vector2d> points;
  for (const Eigen::Vector2i& cell : backtrack(floor, ways, *from)) {
    points.push_back(floor.grid.centre_of(cell.x(), cell.y()));
  }
  points.front() = start;
  points.back() = end;
  if (points.size() == 1) points = {start, end};
  return {straightened(floor, points), ""};
}

}  // namespace tagfield
