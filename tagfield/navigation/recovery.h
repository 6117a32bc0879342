// SPDX-License-Identifier: Apache-2.0
/// @file
/// Recovery behaviours of a robot that makes no progress.
#pragma once

#include <optional>

#include "tagfield/base/time.h"
#include "tagfield/motion/speed_limits.h"
#include "tagfield/motion/unicycle.h"

namespace tagfield {

/// Alternately looks around, since the laser sees only ahead, and backs up a little.
class Recovery {
 public:
  /// Begins the next try.
  void begin(const PlanarPose& pose_M, Time now);
  /// Ends the current try; the next one begins with looking around.
  void reset();
  [[nodiscard]] bool is_on() const { return trying_ != Trying::kNothing; }
  /// The velocity to drive if nothing is in the way; none once the try is over, or if none was
  /// begun.
  std::optional<BodyVelocity> wanted(const PlanarPose& pose_M, Time now, const SpeedLimits& limits);

 private:
  enum class Trying { kNothing, kLookAround, kBackUp };

  Trying trying_ = Trying::kNothing;
  int tries_ = 0;
  Time began_;
  double turned_rad_ = 0.0;
  double last_yaw_ = 0.0;
};

}  // namespace tagfield
