// SPDX-License-Identifier: Apache-2.0
/// @file
/// Whether a drive gets anywhere: when to try something else, and when to give up.
#pragma once

#include "tagfield/base/time.h"

namespace tagfield {

/// Watches what remains to be driven and turned, in metres.
class DriveWatch {
 public:
  /// A new drive, or a new way of the same one, begins at `now`.
  void begin(double remaining_m, Time now);
  /// A longer way was found round something. That may take a while, so patience begins anew, but
  /// only kMostDetours times until the robot has come nearer by kCounts.
  void detour(double remaining_m, Time now);
  void update(double remaining_m, Time now);
  /// Something else was tried until now: stuck_s() begins anew.
  void tried(Time now) { tried_ = now; }

  /// Since it got nearer than ever on this way [s].
  [[nodiscard]] double waited_s(Time now) const { return to_seconds(now - nearer_); }
  /// The same, or since something else was tried [s].
  [[nodiscard]] double stuck_s(Time now) const {
    return to_seconds(now - (tried_ > nearer_ ? tried_ : nearer_));
  }

  static constexpr double kNearer = 0.05;  ///< Less is no progress [m].
  static constexpr double kCounts = 2.0;   ///< [m]
  static constexpr int kMostDetours = 5;

 private:
  double least_m_ = 0.0;
  double counted_from_m_ = 0.0;
  int detours_ = 0;
  Time nearer_;
  Time tried_;
};

}  // namespace tagfield
