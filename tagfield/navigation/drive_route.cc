// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/drive_route.h"

#include "tagfield/motion/planar_pose.h"
#include "tagfield/navigation/global_planner.h"

namespace tagfield {
namespace {

/// How far ahead the path is monitored for obstacles that are not on the map [m],
constexpr double kWatched = 3.0;
/// and how long they must block it before the robot drives around them [s].
constexpr double kBlockedFor = 0.5;
constexpr double kBetweenPlans = 1.0;
/// Distance from its path at which the robot replans [m].
constexpr double kAstray = 0.5;

}  // namespace

std::string DriveRoute::begin(const DriveSenses& senses, const PlanarPose& pose_M,
                              const PlanarPose& goal_M, Time now) {
  clear();
  goal_M_ = goal_M;
  if (plan_anew(senses, pose_M, now)) pursuit_->follow(pose_M);
  return refusal_;
}

void DriveRoute::clear() {
  way_.clear();
  pursuit_.reset();
  blocked_since_.reset();
  block_M_.reset();
  refusal_.clear();
}

void DriveRoute::rewind(Time now) {
  planned_ = now;
  blocked_since_.reset();
}

bool DriveRoute::plan_anew(const DriveSenses& senses, const PlanarPose& pose_M, Time now) {
  planned_ = now;
  map_is_new_ = false;
  Plan found = plan(senses.map(), senses.not_on_map(), pose_M, goal_M_, size_);
  if (!found.refusal.empty()) found = plan(senses.map(), {}, pose_M, goal_M_, size_);
  refusal_ = found.refusal;
  if (!refusal_.empty()) return false;
  way_ = found.way;
  pursuit_.emplace(Polyline(way_), style_);
  blocked_since_.reset();
  return true;
}

void DriveRoute::look_for_blocks(const DriveSenses& senses, const PlanarPose& pose_M, Time now) {
  const double from = pursuit_->along_m();
  const Polyline ahead(pursuit_->way().between(from, from + kWatched));
  const double least = size_.radius_m + 0.5 * size_.margin_m;
  std::optional<Eigen::Vector2d> found;
  double found_along = kWatched;
  for (const Eigen::Vector2d& point : senses.not_on_map()) {
    if ((point - position_of(pose_M)).norm() > kWatched + 1.0) continue;
    const Polyline::Foot foot = ahead.nearest(point, 0.0, kWatched);
    if (foot.distance_m > least || foot.along_m > found_along) continue;
    found = point;
    found_along = foot.along_m;
  }
  if (!found) return blocked_since_.reset();
  block_M_ = found;
  if (!blocked_since_) blocked_since_ = now;
}

bool DriveRoute::follow(const DriveSenses& senses, const PlanarPose& pose_M, Time now) {
  pursuit_->follow(pose_M);
  look_for_blocks(senses, pose_M, now);
  const bool is_blocked = blocked_since_ && to_seconds(now - *blocked_since_) >= kBlockedFor;
  const bool is_astray = pursuit_->distance_m() > kAstray;
  if (!(is_blocked || is_astray || map_is_new_)) return false;
  if (to_seconds(now - planned_) < kBetweenPlans) return false;
  if (!plan_anew(senses, pose_M, now)) return false;
  pursuit_->follow(pose_M);
  return true;
}

}  // namespace tagfield
