// SPDX-License-Identifier: Apache-2.0
/// @file
/// A simulation synchronized with the wall clock.
#pragma once

#include <chrono>
#include <thread>

#include "tagfield/base/time.h"

namespace tagfield {

/// Sleeps until the wall clock, scaled by `real_time`, has caught up with the simulation.
class Pace {
 public:
  explicit Pace(double real_time) : real_time_(real_time) {}
  void wait_for(Time simulated) const {
    if (!(real_time_ > 0.0)) return;
    const std::chrono::duration<double> due(to_seconds(simulated) / real_time_);
    std::this_thread::sleep_until(begin_ + due);
  }

 private:
  double real_time_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace tagfield
