// SPDX-License-Identifier: Apache-2.0
/// @file
/// Collision-free velocity commands: rollouts of many manoeuvres by the dynamic window approach
/// (Fox, Burgard, Thrun, 1997). docs/driving.md has the equations and weights.
#pragma once

#include <optional>

#include "tagfield/navigation/rollout.h"

namespace tagfield {

/// Why the robot doesn't drive as wanted.
enum class Hindrance { kNone, kStanding, kMoving };

struct Decision {
  BodyVelocity command;  ///< Until the next decision; within the limits of the drive.
  Manoeuvre manoeuvre;
  bool is_evading = false;  ///< Moves out of somebody's way, whatever was wanted.
  Hindrance hindrance = Hindrance::kNone;
};

/// The manoeuvre that comes nearest to driving `wanted` while keeping clear of obstacles. `present`
/// is the robot's velocity, `last` the decision made `period_s` ago.
Decision decide(const PlanarPose& pose_M, const BodyVelocity& present, const BodyVelocity& wanted,
                const Surroundings& around, const std::optional<Decision>& last,
                const LocalSettings& settings);

/// Half the side of a square around the robot that contains everything rollouts may come near to
/// [m].
double window_half(const LocalSettings& settings);

}  // namespace tagfield
