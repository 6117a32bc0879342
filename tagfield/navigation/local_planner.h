// SPDX-License-Identifier: Apache-2.0
/// @file
/// What to drive now, so that nothing is touched: rollouts of many manoeuvres by the dynamic-window
/// approach (Fox, Burgard, Thrun, 1997). docs/driving.md has the equations and weights.
#pragma once

#include <optional>

#include "tagfield/navigation/rollout.h"

namespace tagfield {

/// Why it isn't driven what was wanted.
enum class Hindrance { kNone, kStanding, kMoving };

struct Decision {
  BodyVelocity command;  ///< Until the next decision; within what the drive can do by then.
  Manoeuvre manoeuvre;
  bool is_evading = false;  ///< Gets out of somebody's way, whatever was wanted.
  Hindrance hindrance = Hindrance::kNone;
};

/// The manoeuvre that comes nearest to driving `wanted` and keeps clear. `present` is the robot's
/// velocity, `last` what was decided `period_s` ago.
Decision decide(const PlanarPose& pose_M, const BodyVelocity& present, const BodyVelocity& wanted,
                const Surroundings& around, const std::optional<Decision>& last,
                const LocalSettings& settings);

/// Side of a square around the robot that holds all that rollouts may come near to, halved [m].
double window_half(const LocalSettings& settings);

}  // namespace tagfield
