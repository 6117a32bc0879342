// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/path_pursuit.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/trigonometry.h"
#include "tagfield/base/units.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

constexpr double kBeginTurn = radians(60.0);
constexpr double kEndTurn = radians(10.0);
/// Fractions of the drive's limits, to leave room for corrections.
constexpr double kShareOfBraking = 0.5;
constexpr double kShareOfTurn = 0.7;
constexpr double kPerSecond = 1.5;      ///< Fraction of the remaining path driven per second.
constexpr double kTurnPerSecond = 3.0;  ///< Same for an angle.
constexpr double kMinSpeed = 0.02;      ///< Ensures that the end is reached [m/s].

}  // namespace

double turn_rate(double angle_rad, const SpeedLimits& limits) {
  const double angle = std::abs(angle_rad);
  const double rate =
      std::min({kShareOfTurn * limits.turn_rad_s, kTurnPerSecond * angle,
                std::sqrt(2.0 * kShareOfBraking * limits.turn_acceleration_rad_s2 * angle)});
  return std::copysign(rate, angle_rad);
}

void PathPursuit::follow(const PlanarPose& pose_M) {
  const Polyline::Foot foot =
      way_.nearest(position_of(pose_M), along_m_, along_m_ + 2.0 * style_.look_ahead_m);
  along_m_ = foot.along_m;
  distance_m_ = foot.distance_m;
}

double PathPursuit::bearing(const PlanarPose& pose_M) const {
  const Eigen::Vector2d ahead = way_.at(along_m_ + style_.look_ahead_m) - position_of(pose_M);
  if (ahead.norm() < 1e-6) return 0.0;
  return wrap_to_pi(arc_tangent(ahead.y(), ahead.x()) - pose_M.yaw);
}

double PathPursuit::to_turn_rad(const PlanarPose& pose_M) const {
  const double angle = std::abs(bearing(pose_M));
  return is_turning_ || angle > kBeginTurn ? angle : 0.0;
}

BodyVelocity PathPursuit::wanted(const PlanarPose& pose_M) {
  const double angle = bearing(pose_M);
  if (std::abs(angle) > kBeginTurn) is_turning_ = true;
  if (std::abs(angle) < kEndTurn) is_turning_ = false;
  if (is_turning_) return {0.0, turn_rate(angle, style_.limits)};
  const Eigen::Vector2d here = position_of(pose_M);
  const double distance = (way_.at(along_m_ + style_.look_ahead_m) - here).norm();
  const double remaining = std::max(remaining_m(), (way_.points().back() - here).norm());
  // The arc to the look-ahead point, tangent to the heading.
  const double curvature = 2.0 * sine(angle) / std::max(distance, 1e-3);
  const double max_turn = kShareOfTurn * style_.limits.turn_rad_s;
  const double braking = kShareOfBraking * style_.limits.acceleration_m_s2;
  const double speed = std::min({style_.speed_m_s, style_.limits.speed_m_s,
                                 std::max(kMinSpeed, kPerSecond * remaining),
                                 std::sqrt(2.0 * braking * remaining) + kMinSpeed,
                                 max_turn / std::max(std::abs(curvature), 1e-9)});
  return {speed, speed * curvature};
}

}  // namespace tagfield
