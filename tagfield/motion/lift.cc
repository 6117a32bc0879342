// SPDX-License-Identifier: Apache-2.0
#include "tagfield/motion/lift.h"

#include <algorithm>
#include <cmath>

namespace tagfield {

double lift_height(const Lift& lift, Time time) {
  if (!(lift.travel_m > 0.0)) return 0.0;
  const double travelled = std::fmod(lift.speed_m_s * to_seconds(time), 2.0 * lift.travel_m);
  return lift.travel_m - std::abs(travelled - lift.travel_m);
}

bool LiftGuide::go_to(double height_m) {
  if (!std::isfinite(height_m)) return false;
  target_ = std::clamp(height_m, 0.0, lift_.travel_m);
  return true;
}

double LiftGuide::height(Time time) {
  const double step = lift_.speed_m_s * to_seconds(time - time_);
  time_ = time;
  height_ =
      target_ ? std::clamp(*target_, height_ - step, height_ + step) : lift_height(lift_, time);
  return height_;
}

}  // namespace tagfield
