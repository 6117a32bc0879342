// SPDX-License-Identifier: Apache-2.0
/// @file
/// A robot's belief of its own pose: the truth, the truth with a stated error, wheel odometry, or
/// localization by laser and map.
#pragma once

#include <cstdint>

#include "tagfield/motion/unicycle.h"
#include "tagfield/scenario/robot_spec.h"

namespace tagfield {

/// Error in x, y, yaw.
using PoseError = PlanarPose;

/// Error at the first step, drawn from the stationary distribution.
PoseError first_pose_error(const PoseBelief& belief, std::uint64_t seed, std::uint64_t robot_key);

/// Error `seconds` after `error`: the exact discretization of the process. `step` numbers the draw.
PoseError next_pose_error(const PoseBelief& belief, const PoseError& error, double seconds,
                          std::uint64_t seed, std::uint64_t robot_key, std::uint64_t step);

/// Wheel speeds as encoders and slipping wheels report them over `seconds`.
WheelSpeeds measured_wheel_speeds(const PoseBelief& belief, const DriveGeometry& drive,
                                  const WheelSpeeds& wheels, double seconds, std::uint64_t seed,
                                  std::uint64_t robot_key, std::uint64_t step);

}  // namespace tagfield
