// SPDX-License-Identifier: Apache-2.0
/// @file
/// A vertical joint that carries an antenna up and down (Fig. 11 of the paper).
#pragma once

#include <optional>

#include "tagfield/base/time.h"

namespace tagfield {

/// The joint starts at its lower end at time 0 and moves up and down at constant speed forever.
struct Lift {
  double travel_m = 0.0;  ///< 0 for no joint.
  double speed_m_s = 0.35;
};

/// Height of the joint above its lower end [m] at `time`.
double lift_height(const Lift& lift, Time time);

/// Moves up and down as given by lift_height() until a height is commanded; then moves there at the
/// lift's speed and stays.
class LiftGuide {
 public:
  explicit LiftGuide(const Lift& lift) : lift_(lift) {}

  /// Takes effect at the next call of height(). Heights are clamped to the lift's ends. Returns
  /// false, without effect, if the height is not finite.
  bool go_to(double height_m);
  /// Height above the lower end [m] at `time`. To be called with times that don't decrease.
  double height(Time time);

 private:
  Lift lift_;
  std::optional<double> target_;
  double height_ = 0.0;
  Time time_;
};

}  // namespace tagfield
