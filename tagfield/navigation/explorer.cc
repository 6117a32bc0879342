// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/explorer.h"

#include <algorithm>
#include <cmath>

#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

/// While the map grows, looks whose points or viewpoints are this near to each other are at the
/// same frontier.
constexpr double kSameFrontier = 1.0;
/// A point has been seen when no frontier is left this near to it.
constexpr double kSamePosition = 0.5;
/// A robot this near to its goal has arrived.
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

/// When none are left in a stage, moves on to the next.
std::vector<Frontier> Explorer::open_ones(const OccupancyGrid& map, const OccupancyGrid& drivable,
                                          const PlanarPose& pose_M) {
  FrontierOptions options = options_.frontiers;
  // Walls may yet turn out a cell thicker, and the robot must be able to get out wherever it gets
  // in.
  options.margin_m += map.resolution_m;
  if (stage_ == Stage::kFrontiers) {
    std::vector<Frontier> open = frontiers(map, drivable, pose_M, looks_, options);
    if (!open.empty()) return open;
    stage_ = Stage::kGaps;
  }
  options.min_size_m = std::min(options.min_size_m, options_.finest_m);
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
  if (look_ && !has_ended && has_frontier_near(map, look_->at_M, kSamePosition)) {
    return std::nullopt;
  }
  const std::vector<Frontier> open = open_ones(map, drivable, pose_M);
  if (look_ && is_open(open)) {
    if (!has_ended) return std::nullopt;
    PlanarPose turned = look_->from_M;
    turned.yaw += turns_ == 0 ? options_.look_around_rad : -options_.look_around_rad;
    if (turns_++ < 2 && distance(pose_M, turned) < kThere) return turned;
  }
  // A point that was looked at has nothing more to show, even if it still appears as a frontier.
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
