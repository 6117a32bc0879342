// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where a manoeuvre would lead the robot, and how near to its surroundings.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <vector>

#include "tagfield/motion/speed_limits.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/navigation/distance_window.h"
#include "tagfield/navigation/floor_room.h"
#include "tagfield/navigation/moving_obstacles.h"

namespace tagfield {

/// Changes to a first velocity as fast as the drive can, holds it, does the same with a second one,
/// then brakes and stands.
struct Manoeuvre {
  BodyVelocity first;
  double first_s = 0.0;
  BodyVelocity second;
  double second_s = 0.0;
};

/// The target velocity `seconds` after the beginning.
BodyVelocity target_at(const Manoeuvre& manoeuvre, double seconds);
/// The rest of the manoeuvre after `seconds`.
Manoeuvre rest_of(const Manoeuvre& manoeuvre, double seconds);

/// The robot's surroundings at the time of a decision.
struct Surroundings {
  const DistanceWindow* standing = nullptr;
  /// Distance of the robot's centre from static obstacles, without the window's discretization [m].
  double clear_now_m = 0.0;
  std::vector<MovingObstacle> moving;
  /// Whether a point is known to be free, so that the robot may back over it.
  std::function<bool(const Eigen::Vector2d&)> is_known_free;
};

struct LocalSettings {
  SpeedLimits limits;
  RobotRoom size;
  double period_s = 0.05;  ///< Between decisions.
};

/// Time horizon of rollouts [s]. Every rollout ends with the robot at rest, and nobody may reach it
/// there too soon for it to get out of the way.
inline constexpr double kHorizon = 6.0;

/// The outcome of a manoeuvre.
struct Outcome {
  /// Least distance to static obstacles.
  double clear_m = std::numeric_limits<double>::infinity();
  double end_clear_m = 0.0;  ///< The same at the end.
  /// Least gap between the footprint's circle and moving obstacles, minus their uncertainty.
  double gap_m = std::numeric_limits<double>::infinity();
  bool backs_blindly = false;  ///< Over ground that is not known to be free.
  double moved_m = 0.0;        ///< Distance from the start to the end.
  double turned_rad = 0.0;     ///< Change of heading from the start to the end.
};

class Rollouts {
 public:
  /// Keeps references to `around` and `settings`.
  Rollouts(const PlanarPose& pose_M, const BodyVelocity& present, const Surroundings& around,
           const LocalSettings& settings)
      : pose_M_(pose_M), present_(present), around_(around), settings_(settings) {}

  [[nodiscard]] Outcome outcome(const Manoeuvre& manoeuvre) const;
  /// The pose `seconds` after the beginning.
  [[nodiscard]] PlanarPose after(const Manoeuvre& manoeuvre, double seconds) const;

 private:
  void check(const PlanarPose& pose, const BodyVelocity& velocity, double t, Outcome& result) const;
  void check_rest(const PlanarPose& pose, double from_s, Outcome& result) const;
  [[nodiscard]] double gap(const MovingObstacle& moving, const PlanarPose& pose, double t) const;
  [[nodiscard]] bool is_ground_known_behind(const PlanarPose& pose) const;

  PlanarPose pose_M_;
  BodyVelocity present_;
  const Surroundings& around_;
  const LocalSettings& settings_;
};

}  // namespace tagfield
