// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/time.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "tagfield/base/test/error_text.h"

namespace tagfield {
namespace {

constexpr std::int64_t kMost = 4'600'000'000'000'000'000;

Time at(std::int64_t nanos) { return Time(Duration(nanos)); }

TEST(FormatStamp, HasNineDecimals) {
  EXPECT_EQ(format_stamp(at(0)), "0.000000000");
  EXPECT_EQ(format_stamp(at(12'066'666'667)), "12.066666667");
  EXPECT_EQ(format_stamp(at(-500'000'000)), "-0.500000000");
  EXPECT_EQ(format_stamp(at(-1)), "-0.000000001");
  EXPECT_EQ(format_stamp(at(std::numeric_limits<std::int64_t>::min())), "-9223372036.854775808");
  EXPECT_EQ(format_stamp(at(std::numeric_limits<std::int64_t>::max())), "9223372036.854775807");
}

RC_GTEST_PROP(ParseStamp, ReadsBackWhatFormatWrote, (std::int64_t nanos)) {
  const Time time = at(nanos % kMost);
  RC_ASSERT(parse_stamp(format_stamp(time)) == time);
}

TEST(ParseStamp, ReadsUnixTimeToTheNanosecond) {
  EXPECT_EQ(parse_stamp("1700000000.123456789"), at(1'700'000'000'123'456'789));
  EXPECT_EQ(parse_stamp("1700000000.000000001"), at(1'700'000'000'000'000'001));
  EXPECT_EQ(parse_stamp("-1700000000.123456789"), at(-1'700'000'000'123'456'789));
  EXPECT_EQ(parse_stamp("1700000000"), at(1'700'000'000'000'000'000));
}

TEST(ParseStamp, ReadsEveryPlainForm) {
  EXPECT_EQ(parse_stamp("3e-3"), at(3'000'000));
  EXPECT_EQ(parse_stamp("1.5E2"), at(150'000'000'000));
  EXPECT_EQ(parse_stamp("+2"), at(2'000'000'000));
  EXPECT_EQ(parse_stamp("5."), at(5'000'000'000));
  EXPECT_EQ(parse_stamp(".5"), at(500'000'000));
  EXPECT_EQ(parse_stamp("-.5"), at(-500'000'000));
  EXPECT_EQ(parse_stamp("007"), at(7'000'000'000));
  EXPECT_EQ(parse_stamp("-0"), at(0));
}

TEST(ParseStamp, RoundsBeyondTheNanosecond) {
  EXPECT_EQ(parse_stamp("0.0000000014999"), at(1));
  EXPECT_EQ(parse_stamp("0.0000000015"), at(2));
  EXPECT_EQ(parse_stamp("-0.0000000015"), at(-2));
  EXPECT_EQ(parse_stamp("1.9999999999999"), at(2'000'000'000));
}

TEST(ParseStamp, RefusesAllElse) {
  for (const char* text :
       {"",  ".",   "1e",  "nan", "inf", "-inf", "12.3.4", "1e400", "abc", "-",
        "+", "--1", "+-1", "-+1", " 1",  "1 ",   "1s",     "0x10",  "1,5", "12:30"}) {
    const std::string message = error_of([&] { parse_stamp(text); });
    EXPECT_EQ(message, std::string("'").append(text).append("' is not a time in seconds"));
  }
}

TEST(ParseStamp, RefusesWhatNoStampHolds) {
  for (const char* text :
       {"4600000000", "-4600000000", "9199999999", "99999999999999999999", "-4.7e9", "1e30"}) {
    EXPECT_THROW(parse_stamp(text), Error) << text;
  }
  EXPECT_EQ(parse_stamp("4599999999.999999999"), at(kMost - 1));
  EXPECT_EQ(
      error_of([] { parse_stamp("-9199999999.5"); }),
      "stamp -9199999999.5 s is not a valid time: expected less than 4.6e+09 s (146 years) from 0");
}

TEST(ParseStamp, TakesOnlyStampsWhoseDifferencesAreDurations) {
  const Duration apart = parse_stamp("4599999999.999999999") - parse_stamp("-4599999999.999999999");
  EXPECT_EQ(apart.count(), 2 * (kMost - 1));
  EXPECT_EQ(duration_from_seconds(9.19e9).count(), 9'190'000'000'000'000'000);
  EXPECT_THROW(time_from_seconds(4.6e9), Error);
  EXPECT_THROW(time_from_seconds(std::numeric_limits<double>::quiet_NaN()), Error);
}

TEST(DurationFromSeconds, IsTheNearestNanosecond) {
  EXPECT_EQ(duration_from_seconds(0.1), Duration(100'000'000));
  EXPECT_EQ(duration_from_seconds(-1.0 / 3.0), Duration(-333'333'333));
  EXPECT_EQ(duration_from_seconds(1.6e-9), Duration(2));
}

TEST(DurationFromSeconds, RefusesWhatIsNoTime) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  for (const double seconds :
       {kInfinite, -kInfinite, std::numeric_limits<double>::quiet_NaN(), 9.3e9, -9.3e9, 1e300}) {
    EXPECT_THROW(duration_from_seconds(seconds), Error) << seconds;
  }
}

RC_GTEST_PROP(ToSeconds, ReturnsFromSeconds, ()) {
  const Time time = at(*rc::gen::inRange<std::int64_t>(-1'000'000'000'000, 1'000'000'000'000));
  RC_ASSERT(time_from_seconds(to_seconds(time)) == time);
}

}  // namespace
}  // namespace tagfield
