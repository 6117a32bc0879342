// SPDX-License-Identifier: Apache-2.0
#include "tagfield/motion/path_follower.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/trigonometry.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr double kBeginTurnInPlace = radians(80.0);
constexpr double kEndTurnInPlace = radians(5.0);

/// Arc length of the point of the segment `a`–`b` nearest to `p`, from `a`.
double nearest_on_segment(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                          const Eigen::Vector2d& p) {
  const double length = (b - a).norm();
  return std::clamp((p - a).dot(b - a) / length, 0.0, length);
}

}  // namespace

PathFollower::PathFollower(const PlanarPose& start, const std::vector<Eigen::Vector2d>& waypoints,
                           const DrivingStyle& style)
    : style_(style) {
  path_.emplace_back(start.x, start.y);
  arc_lengths_.push_back(0.0);
  for (const Eigen::Vector2d& waypoint : waypoints) {
    const double length = (waypoint - path_.back()).norm();
    if (length < 1e-9) continue;
    arc_lengths_.push_back(arc_lengths_.back() + length);
    path_.push_back(waypoint);
  }
  finished_ = path_.size() < 2;
}

Eigen::Vector2d PathFollower::point_at(double arc_length) const {
  const auto after = std::upper_bound(arc_lengths_.begin(), arc_lengths_.end(), arc_length);
  if (after == arc_lengths_.end()) return path_.back();
  const auto end = static_cast<std::size_t>(after - arc_lengths_.begin());
  const double fraction =
      (arc_length - arc_lengths_[end - 1]) / (arc_lengths_[end] - arc_lengths_[end - 1]);
  return path_[end - 1] + fraction * (path_[end] - path_[end - 1]);
}

/// Advances to the nearest point of the path, searching only a little ahead, so that a path that
/// crosses itself is not cut short.
void PathFollower::follow_progress(const Eigen::Vector2d& position) {
  const double limit = progress_ + style_.look_ahead_m;
  double nearest = (point_at(progress_) - position).norm();
  for (std::size_t i = 1; i < path_.size(); ++i) {
    if (arc_lengths_[i] < progress_ || arc_lengths_[i - 1] > limit) continue;
    const double along = nearest_on_segment(path_[i - 1], path_[i], position);
    const double candidate = std::clamp(arc_lengths_[i - 1] + along, progress_, limit);
    const double distance = (point_at(candidate) - position).norm();
    if (distance < nearest) {
      nearest = distance;
      progress_ = candidate;
    }
  }
}

BodyVelocity PathFollower::next(const PlanarPose& pose, double seconds) {
  const Eigen::Vector2d position(pose.x, pose.y);
  follow_progress(position);
  const double remaining = (path_.back() - position).norm();
  const double step = style_.speed_m_s * seconds;
  const bool at_end = arc_lengths_.back() - progress_ < style_.look_ahead_m && remaining <= step;
  if (finished_ || at_end) {
    finished_ = true;
    return {};
  }
  const Eigen::Vector2d target = point_at(progress_ + style_.look_ahead_m);
  const Eigen::Vector2d to_target = target - position;
  const double bearing = wrap_to_pi(arc_tangent(to_target.y(), to_target.x()) - pose.yaw);
  const double max_turn = style_.max_turn_rad_s;
  if (std::abs(bearing) > kBeginTurnInPlace) turning_in_place_ = true;
  if (turning_in_place_ && std::abs(bearing) < kEndTurnInPlace) turning_in_place_ = false;
  if (turning_in_place_) {
    return {0.0, std::clamp(bearing / seconds, -max_turn, max_turn)};
  }
  // The arc to the target, tangent to the heading, has the curvature 2 sin(bearing)/distance.
  const double curvature = 2.0 * sine(bearing) / std::max(to_target.norm(), 1e-9);
  const double forward = std::min(style_.speed_m_s, max_turn / std::max(std::abs(curvature), 1e-9));
  return {forward, forward * curvature};
}

}  // namespace tagfield
