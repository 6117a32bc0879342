// SPDX-License-Identifier: Apache-2.0
#include "tagfield/motion/speed_limits.h"

#include <algorithm>

namespace tagfield {
namespace {

double limited(double wanted, double present, double most, double max_change) {
  const double possible = std::clamp(wanted, -most, most);
  return std::clamp(possible, present - max_change, present + max_change);
}

}  // namespace

BodyVelocity limited(const BodyVelocity& wanted, const BodyVelocity& present,
                     const SpeedLimits& limits, double seconds) {
  return {limited(wanted.forward, present.forward, limits.speed_m_s,
                  limits.acceleration_m_s2 * seconds),
          limited(wanted.turn, present.turn, limits.turn_rad_s,
                  limits.turn_acceleration_rad_s2 * seconds)};
}

}  // namespace tagfield
