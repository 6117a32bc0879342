// SPDX-License-Identifier: Apache-2.0
/// @file
/// When a live world's steps are due on the wall.
#pragma once

#include <chrono>

#include "tagfield/base/time.h"

namespace tagfield {

/// Maps simulated time to the wall clock's, which is handed in. Where the simulation falls behind,
/// what it lacks by then is not made up for: it goes on at its speed from there.
class LiveClock {
 public:
  using Wall = std::chrono::steady_clock::time_point;

  /// `speed`: multiple of real time, 0 for as fast as it can.
  LiveClock(double speed, bool is_paused);

  [[nodiscard]] double speed() const { return speed_; }
  [[nodiscard]] bool is_paused(Time now) const { return now >= until_; }
  void set_speed(double speed, Time now, Wall wall);
  void pause();
  void resume(Time now, Wall wall);
  /// Until `until`, and is paused then.
  void run_until(Time until, Time now, Wall wall);

  /// When the step that ends at `end` may end.
  [[nodiscard]] Wall due(Time end) const;
  /// The step that ended at `now` is over at `wall`.
  void stepped(Time now, Wall wall);
  /// Simulated over real time, over the last second or so.
  [[nodiscard]] double pace(Time now, Wall wall) const;

 private:
  void anchor(Time now, Wall wall);
  void measure_from(Time now, Wall wall);

  double speed_;
  Time until_;
  Time anchor_{};
  Wall anchor_wall_{};
  // The present second, and what came of the one before.
  Time second_{};
  Wall second_wall_{};
  double pace_ = 0.0;
};

}  // namespace tagfield
