/// @file
/// A vertical joint that carries an antenna up and down (Fig. 11 of the paper).
#pragma once

#include "tagfield/base/time.h"

namespace tagfield {

/// The joint starts at its lower end at time 0 and goes up and down at constant speed for ever.
struct Lift {
  double travel_m = 0.0;  ///< 0 for no joint.
  double speed_m_s = 0.35;
};

/// Height of the joint above its lower end [m] at `time`.
double lift_height(const Lift& lift, Time time);

}  // namespace tagfield
