// SPDX-License-Identifier: Apache-2.0
/// @file
/// Limits of a robot's drive, and clamping of commands to them.
#pragma once

#include "tagfield/motion/unicycle.h"

namespace tagfield {

/// Limits of a drive; the defaults suit a P3-AT. All are > 0.
struct SpeedLimits {
  double speed_m_s = 0.8;
  double turn_rad_s = 1.5;
  double acceleration_m_s2 = 1.0;
  double turn_acceleration_rad_s2 = 3.0;
};

/// The velocity nearest to `wanted` that a drive with the velocity `present` can reach within
/// `seconds`. `wanted` must be finite.
BodyVelocity limited(const BodyVelocity& wanted, const BodyVelocity& present,
                     const SpeedLimits& limits, double seconds);

}  // namespace tagfield
