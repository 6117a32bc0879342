// SPDX-License-Identifier: Apache-2.0
/// @file
/// Decides how a robot moves: by external commands, or else along its waypoints.
#pragma once

#include <optional>

#include "tagfield/base/time.h"
#include "tagfield/motion/path_follower.h"
#include "tagfield/motion/speed_limits.h"
#include "tagfield/motion/unicycle.h"

namespace tagfield {

struct DriverSettings {
  SpeedLimits limits;
  /// How long a command is valid.
  Duration command_timeout = std::chrono::milliseconds(500);
  /// Interval between steering decisions on the path.
  Duration steering_interval = std::chrono::milliseconds(50);
};

/// A command drives the robot until the timeout; without one the robot drives along its remaining
/// waypoints, if any, and otherwise stands still. Uses no clock other than the times it is given,
/// so the same calls give the same motion.
class RobotDriver {
 public:
  explicit RobotDriver(const DriverSettings& settings) : settings_(settings) {}

  /// Sets the waypoints to drive.
  void set_path(PathFollower path) { path_ = std::move(path); }
  /// Takes a command at time `now`. Returns false, without effect, if it is not finite.
  bool command(const BodyVelocity& velocity, Time now);
  /// The velocity to drive at `now`, given the robot's `pose` then. To be called with times that
  /// don't decrease.
  BodyVelocity next(const PlanarPose& pose, Time now);
  /// Whether there are waypoints and the last of them has been reached.
  [[nodiscard]] bool finished() const { return path_ && path_->finished(); }

 private:
  struct Command {
    BodyVelocity velocity;
    Time given;
  };

  BodyVelocity wanted(const PlanarPose& pose, Time now);

  DriverSettings settings_;
  std::optional<PathFollower> path_;
  std::optional<Command> command_;
  std::optional<Time> steered_;  ///< Time of the last steering decision.
  BodyVelocity steering_;
  std::optional<Time> last_;  ///< Call of next().
  BodyVelocity velocity_;
};

}  // namespace tagfield
