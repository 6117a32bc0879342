// SPDX-License-Identifier: Apache-2.0
/// @file
/// Decides how a robot moves: by commands from outside, or else along its waypoints.
#pragma once

#include <optional>

#include "tagfield/base/time.h"
#include "tagfield/motion/path_follower.h"
#include "tagfield/motion/speed_limits.h"
#include "tagfield/motion/unicycle.h"

namespace tagfield {

struct DriverSettings {
  SpeedLimits limits;
  /// How long a command holds.
  Duration command_timeout = std::chrono::milliseconds(500);
  /// How often the path's steering is decided anew.
  Duration steering_interval = std::chrono::milliseconds(50);
};

/// A command drives the robot until it is as old as the timeout; without one the robot drives along
/// its waypoints, if there are any left, and stands otherwise. Knows no clock but the times that it
/// is given, so the same calls give the same motion.
class RobotDriver {
 public:
  explicit RobotDriver(const DriverSettings& settings) : settings_(settings) {}

  /// Gives the waypoints to drive.
  void set_path(PathFollower path) { path_ = std::move(path); }
  /// Takes a command at time `now`. Returns false, and leaves all as it was, if it is not finite.
  bool command(const BodyVelocity& velocity, Time now);
  /// The velocity to have at `now`, at which the robot is at `pose`. To be called with times that
  /// don't fall.
  BodyVelocity next(const PlanarPose& pose, Time now);
  /// Whether there are waypoints, and the last of them is reached.
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
  std::optional<Time> steered_;  ///< When the path's steering was decided last.
  BodyVelocity steering_;
  std::optional<Time> last_;  ///< Call of next().
  BodyVelocity velocity_;
};

}  // namespace tagfield
