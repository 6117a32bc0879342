// SPDX-License-Identifier: Apache-2.0
/// @file
/// A vertical joint that carries an antenna up and down (Fig. 11 of the paper).
#pragma once

#include <optional>

#include "tagfield/base/time.h"

namespace tagfield {

/// The joint starts at its lower end at time 0 and goes up and down at constant speed for ever.
struct Lift {
  double travel_m = 0.0;  ///< 0 for no joint.
  double speed_m_s = 0.35;
};

/// Height of the joint above its lower end [m] at `time`.
double lift_height(const Lift& lift, Time time);

/// Goes up and down as lift_height() says, until it is told a height: then it goes there at the
/// lift's speed and stays.
class LiftGuide {
 public:
  explicit LiftGuide(const Lift& lift) : lift_(lift) {}

  /// Takes effect at the next call of height(). Heights beyond an end are that end. Returns false,
  /// and leaves all as it was, if it is not finite.
  bool go_to(double height_m);
  /// Height above the lower end [m] at `time`. To be called with times that don't fall.
  double height(Time time);

 private:
  Lift lift_;
  std::optional<double> target_;
  double height_ = 0.0;
  Time time_;
};

}  // namespace tagfield
