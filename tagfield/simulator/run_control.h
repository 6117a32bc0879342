// SPDX-License-Identifier: Apache-2.0
/// @file
/// How to run, as opposed to what.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <thread>

#include "tagfield/base/time.h"
#include "tagfield/stream/listeners.h"

namespace tagfield {

class NavigationListener;
struct RemoteDriving;

/// Threads, progress, and an early end.
struct RunControl {
  int threads = 1;
  const std::atomic<bool>* stop = nullptr;         ///< Set by others to end early.
  std::function<void(double share)> on_progress;   ///< Called now and then with 0 … 1, or empty.
  Outlets outlets;                                 ///< Told of the first seed's run, as it goes.
  std::shared_ptr<NavigationListener> navigation;  ///< Of that run, too; or null.
  const RemoteDriving* remote = nullptr;           ///< Who drives a robot from outside, if anybody.
  bool keeps_recording = true;  ///< Else memory does not grow with the run, and nothing is located.
};

/// Whether the run is to end early.
inline bool stopped(const RunControl& control) { return control.stop != nullptr && *control.stop; }

/// Sleeps until the wall clock is as far as the simulation at its pace.
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
