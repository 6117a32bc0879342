#include "tagfield/motion/lift.h"

#include <cmath>

namespace tagfield {

double lift_height(const Lift& lift, Time time) {
  if (!(lift.travel_m > 0.0)) return 0.0;
  const double travelled = std::fmod(lift.speed_m_s * to_seconds(time), 2.0 * lift.travel_m);
  return lift.travel_m - std::abs(travelled - lift.travel_m);
}

}  // namespace tagfield
