// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/rollout.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/trigonometry.h"
#include "tagfield/base/units.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

constexpr double kStep = 0.1;  // [s]
constexpr double kAlmost = 1e-9;
/// Growth of the uncertainty about a moving obstacle's position [m/s], and its maximum [m].
constexpr double kUnsure = 0.1;
constexpr double kMaxUnsure = 0.25;

/// Steps the robot through a manoeuvre.
struct ReachedWalk {
  PlanarPose pose;
  BodyVelocity velocity;
  BodyVelocity mean{};  ///< Of the last step,
  Arc arc{};            ///< which was this.
  double t = 0.0;

  /// Returns false, without a step, once the manoeuvre is over and the robot stands.
  bool step(const Manoeuvre& manoeuvre, const SpeedLimits& limits) {
    const BodyVelocity next = limited(target_at(manoeuvre, t), velocity, limits, kStep);
    const BodyVelocity now{0.5 * (velocity.forward + next.forward),
                           0.5 * (velocity.turn + next.turn)};
    // Most steps are like the one before.
    if (now.forward != mean.forward || now.turn != mean.turn) arc = arc_of(now, kStep);
    mean = now;
    const bool is_over = t > manoeuvre.first_s + manoeuvre.second_s - kAlmost;
    if (is_over && mean.forward == 0.0 && mean.turn == 0.0) return false;
    velocity = next;
    t += kStep;
    pose = advance(pose, arc);
    return true;
  }
};

}  // namespace

BodyVelocity target_at(const Manoeuvre& manoeuvre, double seconds) {
  if (seconds < manoeuvre.first_s - kAlmost) return manoeuvre.first;
  if (seconds < manoeuvre.first_s + manoeuvre.second_s - kAlmost) return manoeuvre.second;
  return {};
}

Manoeuvre rest_of(const Manoeuvre& manoeuvre, double seconds) {
  Manoeuvre rest = manoeuvre;
  const double of_first = std::min(seconds, rest.first_s);
  rest.first_s -= of_first;
  rest.second_s = std::max(0.0, rest.second_s - (seconds - of_first));
  return rest;
}

/// Checks the rear half of the footprint's circle, which leads when backing up.
bool Rollouts::is_ground_known_behind(const PlanarPose& pose) const {
  constexpr int kPoints = 7;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = pose.yaw + kPi / 2.0 + kPi * i / (kPoints - 1);
    const Eigen::Vector2d direction(cosine(angle), sine(angle));
    if (!around_.is_known_free(position_of(pose) + settings_.size.radius_m * direction)) {
      return false;
    }
  }
  return true;
}

double Rollouts::gap(const MovingObstacle& moving, const PlanarPose& pose, double t) const {
  return (moving.at(t) - position_of(pose)).norm() - moving.radius_m - settings_.size.radius_m -
         std::min(kUnsure * t, kMaxUnsure);
}

void Rollouts::check(const PlanarPose& pose, const BodyVelocity& velocity, double t,
                     Outcome& result) const {
  if (velocity.forward != 0.0) {
    result.end_clear_m = around_.standing->at(position_of(pose));
    result.clear_m = std::min(result.clear_m, result.end_clear_m);
  }
  if (velocity.forward < 0.0 && !result.backs_blindly) {
    result.backs_blindly = !is_ground_known_behind(pose);
  }
  for (const MovingObstacle& moving : around_.moving) {
    result.gap_m = std::min(result.gap_m, gap(moving, pose, t));
  }
}

/// While the robot stands, from `from_s` to the horizon, each moving obstacle has one moment of
/// closest approach.
void Rollouts::check_rest(const PlanarPose& pose, double from_s, Outcome& result) const {
  for (const MovingObstacle& moving : around_.moving) {
    const Eigen::Vector2d away = position_of(pose) - moving.centre_M;
    const double speed_square = std::max(moving.velocity_M.squaredNorm(), 1e-9);
    const double nearest =
        std::clamp(away.dot(moving.velocity_M) / speed_square, from_s, std::max(from_s, kHorizon));
    result.gap_m = std::min(result.gap_m, gap(moving, pose, nearest));
  }
}

Outcome Rollouts::outcome(const Manoeuvre& manoeuvre) const {
  Outcome result;
  result.end_clear_m = around_.standing->at(position_of(pose_M_));
  result.clear_m = result.end_clear_m;
  ReachedWalk walk{pose_M_, present_};
  while (walk.t < kHorizon && walk.step(manoeuvre, settings_.limits)) {
    check(walk.pose, walk.mean, walk.t, result);
  }
  check_rest(walk.pose, walk.t, result);
  result.moved_m = (position_of(walk.pose) - position_of(pose_M_)).norm();
  result.turned_rad = std::abs(walk.pose.yaw - pose_M_.yaw);
  return result;
}

PlanarPose Rollouts::after(const Manoeuvre& manoeuvre, double seconds) const {
  ReachedWalk walk{pose_M_, present_};
  while (walk.t < seconds - kAlmost && walk.step(manoeuvre, settings_.limits)) {
  }
  return walk.pose;
}

}  // namespace tagfield
