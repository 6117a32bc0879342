// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/utc.h"

#include <fmt/format.h>
#include <time.h>

#include <cstdlib>

#include "tagfield/base/error.h"

namespace tagfield {
namespace {

using std::chrono::minutes;
constexpr minutes kMaxZone = std::chrono::hours(14);

/// Takes `digits` digits off the front of `rest`; -1 if there are fewer.
int take_number(std::string& rest, std::size_t digits) {
  const std::string text = rest.substr(0, digits);
  if (text.size() != digits || text.find_first_not_of("0123456789") != std::string::npos) return -1;
  rest.erase(0, digits);
  return std::stoi(text);
}

bool take(std::string& rest, char c) {
  if (rest.empty() || rest.front() != c) return false;
  rest.erase(0, 1);
  return true;
}

/// ".25" as nanoseconds; 0 without a decimal point, -1 if no digit follows it.
std::int64_t take_fraction(std::string& rest) {
  if (!take(rest, '.')) return 0;
  std::int64_t nanoseconds = 0;
  std::int64_t unit = 100'000'000;
  std::size_t digits = 0;
  for (; digits < rest.size() && rest[digits] >= '0' && rest[digits] <= '9'; ++digits, unit /= 10) {
    nanoseconds += (rest[digits] - '0') * unit;
  }
  rest.erase(0, digits);
  return digits == 0 ? -1 : nanoseconds;
}

/// "Z" or "+01:00"; false if it is neither.
bool take_zone(std::string& rest, minutes& zone) {
  if (take(rest, 'Z')) return true;
  const bool is_west = !rest.empty() && rest.front() == '-';
  if (!take(rest, '+') && !take(rest, '-')) return false;
  const int hours = take_number(rest, 2);
  const bool has_colon = take(rest, ':');
  const int past = take_number(rest, 2);
  zone = minutes((is_west ? -1 : 1) * (60 * hours + past));
  return hours >= 0 && past >= 0 && past < 60 && has_colon && std::chrono::abs(zone) <= kMaxZone;
}

bool take_date(std::string& rest, tm& civil) {
  civil.tm_year = take_number(rest, 4) - 1900;
  const bool has_month = take(rest, '-');
  civil.tm_mon = take_number(rest, 2) - 1;
  const bool has_day = take(rest, '-');
  civil.tm_mday = take_number(rest, 2);
  return has_month && has_day && civil.tm_mday >= 1;
}

bool take_clock(std::string& rest, tm& civil) {
  civil.tm_hour = take_number(rest, 2);
  const bool has_minutes = take(rest, ':');
  civil.tm_min = take_number(rest, 2);
  const bool has_seconds = take(rest, ':');
  civil.tm_sec = take_number(rest, 2);
  return has_minutes && has_seconds && civil.tm_hour >= 0 && civil.tm_min >= 0 && civil.tm_sec >= 0;
}

[[noreturn]] void refuse(const std::string& text) {
  throw Error(
      fmt::format("'{}' must be a time such as 2020-01-01T00:00:00Z, from 1830 to 2114", text));
}

/// Seconds since 1970; refuses dates that don't exist, such as February 30th.
std::int64_t seconds_of(const tm& civil, const std::string& text) {
  tm normal = civil;
  const time_t seconds = timegm(&normal);
  const bool is_same = normal.tm_year == civil.tm_year && normal.tm_mon == civil.tm_mon &&
                       normal.tm_mday == civil.tm_mday && normal.tm_hour == civil.tm_hour &&
                       normal.tm_min == civil.tm_min && normal.tm_sec == civil.tm_sec;
  const int year = civil.tm_year + 1900;
  if (!is_same || year < 1830 || year > 2114) refuse(text);
  return seconds;
}

}  // namespace

Time utc_from_text(const std::string& text) {
  std::string rest = text;
  tm civil{};
  minutes zone{0};
  std::int64_t nanoseconds = 0;
  if (!take_date(rest, civil)) refuse(text);
  if (!rest.empty()) {
    const bool has_clock = take(rest, 'T') && take_clock(rest, civil);
    nanoseconds = has_clock ? take_fraction(rest) : -1;
    if (nanoseconds < 0 || !take_zone(rest, zone) || !rest.empty()) refuse(text);
  }
  return Time(std::chrono::seconds(seconds_of(civil, text)) - zone) + Duration(nanoseconds);
}

std::string utc_text(Time since_1970, int decimals, minutes zone) {
  const Time local = since_1970 + zone;
  const auto whole = std::chrono::floor<std::chrono::seconds>(local);
  const time_t seconds = whole.time_since_epoch().count();
  tm civil{};
  gmtime_r(&seconds, &civil);
  std::string text =
      fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}", civil.tm_year + 1900, civil.tm_mon + 1,
                  civil.tm_mday, civil.tm_hour, civil.tm_min, civil.tm_sec);
  if (decimals > 0) {
    const std::string digits = fmt::format("{:09}", Duration(local - whole).count());
    text += '.' + digits.substr(0, static_cast<std::size_t>(decimals));
  }
  return text + (zone.count() == 0 ? "Z" : zone_text(zone));
}

std::string zone_text(minutes zone) {
  const auto size = std::abs(zone.count());
  return fmt::format("{}{:02}:{:02}", zone.count() < 0 ? '-' : '+', size / 60, size % 60);
}

minutes zone_from_text(const std::string& text) {
  std::string rest = text;
  minutes zone{0};
  if (text == "Z" || !take_zone(rest, zone) || !rest.empty()) {
    throw Error(fmt::format("'{}' must be an offset from UTC such as +01:00", text));
  }
  return zone;
}

}  // namespace tagfield
