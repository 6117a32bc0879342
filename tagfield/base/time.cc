// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/time.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "tagfield/base/error.h"
#include "tagfield/base/number.h"

namespace tagfield {
namespace {

constexpr double kMaxSeconds = 9.2e9;  // 2^63 ns
constexpr double kMaxStamp = 4.6e9;    // The difference of any two stamps is a Duration.
constexpr std::int64_t kNanosPerSecond = 1'000'000'000;

/// Parses "123.25" digit by digit, because a double resolves today's Unix time only to 0.2 µs.
bool parse_plain_decimal(const std::string& text, std::int64_t& nanos) {
  std::size_t i = 0;
  const bool negative = !text.empty() && text[0] == '-';
  if (negative || (!text.empty() && text[0] == '+')) ++i;
  std::int64_t whole = 0;
  const char* begin = text.data() + i;
  const char* end = text.data() + text.size();
  const auto [after, error] = std::from_chars(begin, end, whole);
  if (error != std::errc{} || *begin == '-' || whole >= static_cast<std::int64_t>(kMaxStamp)) {
    return false;
  }
  std::int64_t fraction = 0;
  if (after != end) {
    if (*after != '.') return false;
    std::int64_t scale = kNanosPerSecond;
    for (const char* digit = after + 1; digit != end; ++digit) {
      if (*digit < '0' || *digit > '9') return false;
      if (scale > 1) {
        scale /= 10;
        fraction += (*digit - '0') * scale;
      } else if (scale == 1) {
        scale = 0;
        fraction += *digit >= '5' ? 1 : 0;
      }
    }
  }
  nanos = whole * kNanosPerSecond + fraction;
  if (negative) nanos = -nanos;
  return true;
}

}  // namespace

Duration duration_from_seconds(double seconds) {
  if (!(std::abs(seconds) < kMaxSeconds)) {
    throw Error(fmt::format("time {} s is not a number of seconds within 292 years", seconds));
  }
  return Duration(std::llround(seconds * 1e9));
}

Time time_from_seconds(double seconds) {
  if (!(std::abs(seconds) < kMaxStamp)) {
    throw Error(
        fmt::format("stamp {} s is not a valid time: expected less than {:g} s (146 years) from 0",
                    seconds, kMaxStamp));
  }
  return Time(duration_from_seconds(seconds));
}

std::string format_stamp(Time time) {
  const std::int64_t count = time.time_since_epoch().count();
  const std::uint64_t size = count < 0 ? std::uint64_t{0} - static_cast<std::uint64_t>(count)
                                       : static_cast<std::uint64_t>(count);
  return fmt::format(FMT_COMPILE("{}{}.{:09}"), count < 0 ? "-" : "", size / kNanosPerSecond,
                     size % kNanosPerSecond);
}

Time parse_stamp(const std::string& text) {
  std::int64_t nanos = 0;
  if (parse_plain_decimal(text, nanos)) return Time(Duration(nanos));
  const std::optional<double> seconds = parse_number(text);
  if (!seconds) throw Error(fmt::format("'{}' is not a time in seconds", text));
  return time_from_seconds(*seconds);
}

}  // namespace tagfield
