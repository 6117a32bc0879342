// SPDX-License-Identifier: Apache-2.0
/// @file
/// How a robot comes to believe where it is, as a scenario describes it.
#pragma once

#include <string>

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

}  // namespace tagfield
