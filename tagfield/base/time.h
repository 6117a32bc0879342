// SPDX-License-Identifier: Apache-2.0
/// @file
/// Time of the simulation or of a recording, in integer nanoseconds, so that equal timestamps
/// compare equal.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace tagfield {

/// Tag type of a clock that is never read: time is passed in, by a simulator or from a log.
struct StampClock {
  using rep = std::int64_t;
  using period = std::nano;
  using duration = std::chrono::nanoseconds;
  using time_point = std::chrono::time_point<StampClock>;
  static constexpr bool is_steady = true;
};

using Duration = std::chrono::nanoseconds;
using Time = std::chrono::time_point<StampClock, Duration>;

/// `seconds` rounded to the nearest nanosecond. Throws Error if not finite or outside ±292 years.
Duration duration_from_seconds(double seconds);
/// Same, but throws Error outside ±4.6e9 s (146 years: Unix time until 2115), so that the
/// difference between any two stamps is a Duration.
Time time_from_seconds(double seconds);

inline double to_seconds(Duration duration) { return static_cast<double>(duration.count()) * 1e-9; }
/// Seconds since the epoch of the stamp.
inline double to_seconds(Time time) { return to_seconds(time.time_since_epoch()); }

/// Decimal seconds with nine decimals, exact: "12.066666667", "-0.500000000".
std::string format_stamp(Time time);

/// Inverse of format_stamp(); accepts any plain decimal number of seconds ("1700000000.25",
/// "3e-3"). Rounds to nanoseconds. Throws Error on anything else and where time_from_seconds()
/// does.
Time parse_stamp(const std::string& text);

}  // namespace tagfield
