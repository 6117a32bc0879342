// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/pose_error.h"

#include <cmath>

#include "tagfield/base/lane_math.h"
#include "tagfield/base/random.h"

namespace tagfield {
namespace {

/// Three independent draws scaled to the stationary standard deviations.
PoseError stationary_draw(const PoseBelief& belief, RandomStream& stream) {
  const auto [x, y] = standard_normal_pair(stream);
  return {belief.sigma_m * x, belief.sigma_m * y, belief.yaw_sigma_rad * standard_normal(stream)};
}

}  // namespace

PoseError first_pose_error(const PoseBelief& belief, std::uint64_t seed, std::uint64_t robot_key) {
  RandomStream stream(seed, Purpose::kPoseError, robot_key);
  return stationary_draw(belief, stream);
}

PoseError next_pose_error(const PoseBelief& belief, const PoseError& error, double seconds,
                          std::uint64_t seed, std::uint64_t robot_key, std::uint64_t step) {
  RandomStream stream(seed, Purpose::kPoseError, robot_key, step + 1);
  const double kept = lane_exp(-seconds / belief.time_constant_s);
  const double fresh = std::sqrt(-std::expm1(-2.0 * seconds / belief.time_constant_s));
  const PoseError drawn = stationary_draw(belief, stream);
  return {kept * error.x + fresh * drawn.x, kept * error.y + fresh * drawn.y,
          kept * error.yaw + fresh * drawn.yaw};
}

WheelSpeeds measured_wheel_speeds(const PoseBelief& belief, const DriveGeometry& drive,
                                  const WheelSpeeds& wheels, double seconds, std::uint64_t seed,
                                  std::uint64_t robot_key, std::uint64_t step) {
  RandomStream stream(seed, Purpose::kOdometry, robot_key, step);
  const auto [left, right] = standard_normal_pair(stream);
  const double metres = drive.wheel_radius_m * seconds;  // Travel per rad/s.
  const auto measured = [&](double speed, double draw) {
    return speed + belief.wheel_noise * std::sqrt(std::abs(speed) * metres) * draw / metres;
  };
  return {measured(wheels.left, left), measured(wheels.right, right)};
}

}  // namespace tagfield
