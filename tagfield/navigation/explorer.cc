// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/explorer.h"

#include <algorithm>
#include <cmath>

#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

/// Looks from or at places so near to each other are at the same frontier, as the map grows.
constexpr double kSameFrontier = 1.0;
/// A place is seen when no frontier is left so near to it.
constexpr double kSamePlace = 0.5;
/// A robot so near to where it was sent has got there.
constexpr double kThere = 0.3;

double distance(const PlanarPose& a, const PlanarPose& b) {
  return (position_of(a) - position_of(b)).norm();
}

}  // namespace

OccupancyGrid Explorer::with_start(OccupancyGrid map) const {
  const FrontierOptions& robot = options_.frontiers;
  const double radius_m = robot.radius_m + 2.0 * robot.margin_m;
  const Eigen::Vector2i middle = map.cell_of(position_of(start_M_));
  const int reach = static_cast<int>(std::ceil(radius_m / map.resolution_m));
  for (int y = middle.y() - reach; y <= middle.y() + reach; ++y) {
    for (int x = middle.x() - reach; x <= middle.x() + reach; ++x) {
      const bool inside = (map.centre_of(x, y) - position_of(start_M_)).norm() <= radius_m;
      if (inside && map.contains(x, y) && map.at(x, y) < 0) map.cells[map.index(x, y)] = 0;
    }
  }
  return map;
}

/// None are left in a stage: on to the next.
std::vector<Frontier> Explorer::open_ones(const OccupancyGrid& map, const OccupancyGrid& drivable,
                                          const PlanarPose& pose_M) {
  FrontierOptions options = options_.frontiers;
  // Walls may yet turn out a cell thicker: where the robot gets in, it is to get out again.
  options.margin_m += map.resolution_m;
  if (stage_ == Stage::kFrontiers) {
    std::vector<Frontier> open = frontiers(map, drivable, pose_M, looks_, options);
    if (!open.empty()) return open;
    stage_ = Stage::kGaps;
  }
  options.least_size_m = std::min(options.least_size_m, options_.finest_m);
  return frontiers(map, drivable, pose_M, looks_, options);
}

bool Explorer::is_open(const std::vector<Frontier>& open) const {
  return std::any_of(open.begin(), open.end(), [this](const Frontier& frontier) {
    return distance(frontier.look.from_M, look_->from_M) < kSameFrontier ||
           (frontier.look.at_M - look_->at_M).norm() < kSameFrontier;
  });
}

std::optional<PlanarPose> Explorer::next(const OccupancyGrid& map, const OccupancyGrid& drivable,
                                         const PlanarPose& pose_M, bool has_ended) {
  if (is_going_home()) {
    if (has_ended) stage_ = Stage::kFinished;
    return std::nullopt;
  }
  if (look_ && !has_ended && has_frontier_near(map, look_->at_M, kSamePlace)) {
    return std::nullopt;
  }
  const std::vector<Frontier> open = open_ones(map, drivable, pose_M);
  if (look_ && is_open(open)) {
    if (!has_ended) return std::nullopt;
    PlanarPose turned = look_->from_M;
    turned.yaw += turns_ == 0 ? options_.look_around_rad : -options_.look_around_rad;
    if (turns_++ < 2 && distance(pose_M, turned) < kThere) return turned;
  }
  // Also a place that was looked at and still shows as a frontier has nothing more to show.
  const bool leaves = look_ && has_ended;
  if (leaves) looks_.push_back(*look_);
  look_.reset();
  turns_ = 0;
  const std::vector<Frontier> left = leaves ? open_ones(map, drivable, pose_M) : open;
  if (left.empty()) {
    stage_ = Stage::kGoingHome;
    return start_M_;
  }
  look_ = left.front().look;
  return look_->from_M;
}

}  // namespace tagfield
