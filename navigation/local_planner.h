/// @file
/// What to drive now, so that nothing is touched: rollouts of many manoeuvres by the dynamic-window
/// approach (Fox, Burgard, Thrun, 1997). docs/driving.md has the equations and weights.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "navigation/distance_window.h"
#include "navigation/floor_room.h"
#include "navigation/moving_obstacles.h"
#include "tagfield/motion/speed_limits.h"
#include "tagfield/motion/unicycle.h"

namespace tagfield {

/// Goes over to a velocity as fast as the drive can, holds it, does the same with another, brakes
/// and stands.
struct Manoeuvre {
  BodyVelocity first;
  double first_s = 0.0;
  BodyVelocity second;
  double second_s = 0.0;
};

/// What is around the robot at the moment of a decision.
struct Surroundings {
  const DistanceWindow* standing = nullptr;
  std::vector<MovingObstacle> moving;
  /// Whether the ground at a place is known to be free, so that the robot may back over it.
  std::function<bool(const Eigen::Vector2d&)> is_known_free;
};

struct LocalSettings {
  SpeedLimits limits;
  RobotRoom size;
  double period_s = 0.05;  ///< Between decisions.
};

struct Decision {
  BodyVelocity command;  ///< Until the next decision; within what the drive can do by then.
  Manoeuvre manoeuvre;
  /// Why it isn't what was wanted.
  enum class Hindrance { kNone, kStanding, kMoving } hindrance = Hindrance::kNone;
};

/// The manoeuvre that comes nearest to driving `wanted` and keeps clear. `present` is the robot's
/// velocity, `last` what was decided `period_s` ago.
Decision decide(const PlanarPose& pose_M, const BodyVelocity& present, const BodyVelocity& wanted,
                const Surroundings& around, const std::optional<Manoeuvre>& last,
                const LocalSettings& settings);

/// How far rollouts look ahead [s].
inline constexpr double kHorizon = 3.0;
/// Side of a square around the robot that holds all that rollouts may come near to, halved [m].
double window_half(const LocalSettings& settings);

}  // namespace tagfield
