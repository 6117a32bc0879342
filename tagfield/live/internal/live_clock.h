// SPDX-License-Identifier: Apache-2.0
/// @file
/// When a live world's steps are due in wall-clock time.
#pragma once

#include <chrono>
#include <optional>

#include "tagfield/base/time.h"

namespace tagfield {

/// Maps simulated time to wall-clock time, which is passed in. A simulation that falls more than
/// half a second behind does not catch up: it continues at its speed from there.
class LiveClock {
 public:
  using Wall = std::chrono::steady_clock::time_point;

  /// `speed`: multiple of real time, 0 for as fast as possible.
  LiveClock(double speed, bool is_paused);

  [[nodiscard]] double speed() const { return speed_; }
  [[nodiscard]] bool is_paused(Time now) const { return now >= until_; }
  /// Where run_until() pauses it; none while it is paused or runs without end.
  [[nodiscard]] std::optional<Time> step_end(Time now) const;
  void set_speed(double speed, Time now, Wall wall);
  void pause();
  void resume(Time now, Wall wall);
  /// Runs until `until`, then pauses.
  void run_until(Time until, Time now, Wall wall);
  /// Runs for `simulated`, then pauses. What the last such run went too far, as it ended between
  /// two steps of the simulation, is taken off, unless there was a pause() or resume() since.
  void run_for(Duration simulated, Time now, Wall wall);

  /// Wall-clock time at which the step that ends at `end` may end.
  [[nodiscard]] Wall due(Time end) const;
  /// Records that the step that ended at `now` was completed at `wall`.
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
  // The current second, and the pace of the previous one.
  Time second_{};
  Wall second_wall_{};
  double pace_ = 0.0;
};

}  // namespace tagfield
