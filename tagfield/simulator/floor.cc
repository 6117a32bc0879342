// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/floor.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "tagfield/base/error.h"
#include "tagfield/base/units.h"
#include "tagfield/laser/simulated_laser.h"

namespace tagfield {
namespace {

/// The stationary obstacles that never disappear.
Obstacles standing(const std::vector<ObstacleSpec>& specs) {
  std::vector<ObstacleSpec> kept;
  for (const ObstacleSpec& spec : specs) {
    if (spec.motion.size() == 1 && !spec.disappears) kept.push_back(spec);
  }
  return obstacles_at(kept, Time::max());
}

std::vector<bool> fitting_cells(const OccupancyGrid& truth, const RobotClearance& clearance,
                                const std::vector<ObstacleSpec>& specs, double radius_m) {
  std::vector<bool> not_free;
  not_free.reserve(truth.cells.size());
  for (const std::int8_t cell : truth.cells) not_free.push_back(!is_free(cell));
  const std::vector<float> to_unknown = distance_field(truth, not_free, radius_m + 1.0);
  const Obstacles obstacles = standing(specs);
  std::vector<bool> fits(truth.cells.size(), false);
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      const std::size_t i = truth.index(x, y);
      const Eigen::Vector2d p = truth.centre_of(x, y);
      fits[i] = to_unknown[i] >= static_cast<float>(radius_m) && clearance.room_at(p) >= radius_m &&
                distance_to_obstacles(obstacles, p) >= radius_m;
    }
  }
  return fits;
}

std::optional<Eigen::Vector2i> nearest_fitting(const OccupancyGrid& truth,
                                               const std::vector<bool>& fits,
                                               const Eigen::Vector2d& start) {
  std::optional<Eigen::Vector2i> nearest;
  double least = kNearStart;
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      const double distance = (truth.centre_of(x, y) - start).norm();
      if (!fits[truth.index(x, y)] || distance >= least) continue;
      nearest = {x, y};
      least = distance;
    }
  }
  return nearest;
}

}  // namespace

std::vector<Eigen::Vector2d> reachable_floor(const OccupancyGrid& truth,
                                             const RobotClearance& clearance,
                                             const std::vector<ObstacleSpec>& obstacles,
                                             const Eigen::Vector2d& start, double radius_m) {
  std::vector<bool> is_open = fitting_cells(truth, clearance, obstacles, radius_m);
  const std::optional<Eigen::Vector2i> first = nearest_fitting(truth, is_open, start);
  if (!first) return {};
  std::vector<Eigen::Vector2i> reached{*first};
  is_open[truth.index(first->x(), first->y())] = false;
  for (std::size_t i = 0; i < reached.size(); ++i) {
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const Eigen::Vector2i next(reached[i].x() + dx, reached[i].y() + dy);
      if (!truth.contains(next.x(), next.y()) || !is_open[truth.index(next.x(), next.y())])
        continue;
      is_open[truth.index(next.x(), next.y())] = false;
      reached.push_back(next);
    }
  }
  std::sort(reached.begin(), reached.end(), [](const auto& a, const auto& b) {
    return a.y() != b.y() ? a.y() < b.y() : a.x() < b.x();
  });
  std::vector<Eigen::Vector2d> floor;
  floor.reserve(reached.size());
  for (const Eigen::Vector2i& cell : reached) floor.push_back(truth.centre_of(cell.x(), cell.y()));
  return floor;
}

PlanarPose random_position(const std::vector<Eigen::Vector2d>& floor, RandomStream& stream) {
  if (floor.empty()) throw Error("there is no floor that the robot could be on");
  // From 64 random bits, so that no position is noticeably likelier than another.
  const Eigen::Vector2d& place = floor[stream() % floor.size()];
  return {place.x(), place.y(), wrap_to_pi(kTwoPi * uniform(stream))};
}

}  // namespace tagfield
