/// @file
/// What a robot believes of its own pose: the truth, the truth with a stated error, what its wheels
/// tell, or what it finds by laser and map.
#pragma once

#include <cstdint>
#include <string>

#include "tagfield/motion/unicycle.h"

namespace tagfield {

enum class PoseSource { kTrue, kNoisy, kOdometry, kSlam };

/// "true", "noisy", "odometry", "slam".
std::string to_string(PoseSource source);

struct PoseBelief {
  PoseSource source = PoseSource::kTrue;
  // kNoisy: an Ornstein-Uhlenbeck process in x, y and yaw, stationary from the start.
  double sigma_m = 0.01;         ///< Standard deviation in x and in y.
  double yaw_sigma_rad = 0.0;    ///< Standard deviation of the yaw.
  double time_constant_s = 5.0;  ///< Of the correlation e^(−t/τ); greater than 0.
  // kOdometry
  double wheel_noise = 0.01;  ///< Spread of a wheel's measured travel [m] after 1 m; grows as √m.
};

/// Error in x, y, yaw.
using PoseError = PlanarPose;

/// Error at the first step: drawn from the stationary distribution.
PoseError first_pose_error(const PoseBelief& belief, std::uint64_t seed, std::uint64_t robot_key);

/// Error `seconds` after `error`: the process' exact discretization. `step` numbers the draw.
PoseError next_pose_error(const PoseBelief& belief, const PoseError& error, double seconds,
                          std::uint64_t seed, std::uint64_t robot_key, std::uint64_t step);

/// Wheel speeds as encoders and slipping wheels report them over `seconds`.
WheelSpeeds measured_wheel_speeds(const PoseBelief& belief, const DriveGeometry& drive,
                                  const WheelSpeeds& wheels, double seconds, std::uint64_t seed,
                                  std::uint64_t robot_key, std::uint64_t step);

}  // namespace tagfield
