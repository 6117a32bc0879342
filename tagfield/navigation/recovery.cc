// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/recovery.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr double kBackSpeed = 0.15;  // [m/s]
constexpr double kBackFor = 2.0;     // [s]
constexpr double kLookFor = 6.0;     // At most [s].
/// With a field of view of 180° this shows everything.
constexpr double kLookTurn = radians(170.0);

}  // namespace

void Recovery::begin(const PlanarPose& pose_M, Time now) {
  trying_ = tries_++ % 2 == 0 ? Trying::kLookAround : Trying::kBackUp;
  began_ = now;
  turned_rad_ = 0.0;
  last_yaw_ = pose_M.yaw;
}

void Recovery::reset() {
  trying_ = Trying::kNothing;
  tries_ = 0;
}

std::optional<BodyVelocity> Recovery::wanted(const PlanarPose& pose_M, Time now,
                                             const SpeedLimits& limits) {
  const double lasted_s = to_seconds(now - began_);
  turned_rad_ += std::abs(wrap_to_pi(pose_M.yaw - last_yaw_));
  last_yaw_ = pose_M.yaw;
  if (trying_ == Trying::kLookAround && turned_rad_ < kLookTurn && lasted_s < kLookFor) {
    return BodyVelocity{0.0, 0.5 * limits.turn_rad_s};
  }
  if (trying_ == Trying::kBackUp && lasted_s < kBackFor) {
    return BodyVelocity{-std::min(kBackSpeed, limits.speed_m_s), 0.0};
  }
  trying_ = Trying::kNothing;
  return std::nullopt;
}

}  // namespace tagfield
