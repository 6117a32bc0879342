// SPDX-License-Identifier: Apache-2.0
/// @file
/// Whether a drive makes progress: when to try something else, and when to give up.
#pragma once

#include "tagfield/base/time.h"

namespace tagfield {

/// Monitors the remaining distance and rotation, both expressed in metres.
class DriveWatch {
 public:
  /// Begins a new drive, or a new path of the same drive, at `now`.
  void begin(double remaining_m, Time now);
  /// A longer path around an obstacle was found. Since it may take a while, the timers restart, but
  /// at most kMaxDetours times until the robot has come nearer by kCounts.
  void detour(double remaining_m, Time now);
  void update(double remaining_m, Time now);
  /// A recovery was tried until now: stuck_s() restarts.
  void tried(Time now) { tried_ = now; }

  /// Time since the robot last got nearer to the goal than ever before on this path [s].
  [[nodiscard]] double waited_s(Time now) const { return to_seconds(now - nearer_); }
  /// Time since then or since the last recovery, whichever is later [s].
  [[nodiscard]] double stuck_s(Time now) const {
    return to_seconds(now - (tried_ > nearer_ ? tried_ : nearer_));
  }

  static constexpr double kNearer = 0.05;  ///< Anything less is not progress [m].
  static constexpr double kCounts = 2.0;   ///< [m]
  static constexpr int kMaxDetours = 5;

 private:
  double min_m_ = 0.0;
  double counted_from_m_ = 0.0;
  int detours_ = 0;
  Time nearer_;
  Time tried_;
};

}  // namespace tagfield
