// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/utc.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tagfield/base/test/error_text.h"

namespace tagfield {
namespace {

using std::chrono::minutes;

// Seconds since 1970 from `date -u -d … +%s`.
TEST(UtcFromText, TakesDatesClocksAndZones) {
  EXPECT_EQ(utc_from_text("1970-01-01"), Time{});
  EXPECT_EQ(utc_from_text("2020-01-01T00:00:00Z"), time_from_seconds(1577836800));
  EXPECT_EQ(utc_from_text("2024-02-29T23:59:59.25+01:00"), parse_stamp("1709247599.25"));
  EXPECT_EQ(utc_from_text("2024-02-29T23:59:59.123456789-05:30"),
            parse_stamp("1709270999.123456789"));
  EXPECT_EQ(utc_from_text("1969-12-31T23:59:59Z"), time_from_seconds(-1));
}

TEST(UtcFromText, RefusesAllElse) {
  for (const char* text :
       {"", "2020", "2020-13-01", "2023-02-29", "2020-01-00", "2020-01-01T00:00:00",
        "2020-01-01T24:00:00Z", "2020-01-01T00:60:00Z", "2020-01-01T00:00:00.Z", "1700-01-01",
        "2020-01-01T00:00:00+15:00", "2020-01-01T00:00:00Z ", "2020-1-1", "9999-01-01",
        "2020-01-01 00:00:00Z", "2020-01-01T00:00:00+0100"}) {
    EXPECT_TRUE(contains(error_of([&] { utc_from_text(text); }), "must be a time such as")) << text;
  }
}

TEST(UtcText, HasDecimalsAndZone) {
  const Time time = parse_stamp("1709247599.256789");
  EXPECT_EQ(utc_text(time, 0), "2024-02-29T22:59:59Z");
  EXPECT_EQ(utc_text(time, 3), "2024-02-29T22:59:59.256Z");
  EXPECT_EQ(utc_text(time, 9), "2024-02-29T22:59:59.256789000Z");
  EXPECT_EQ(utc_text(time, 1, minutes(60)), "2024-02-29T23:59:59.2+01:00");
  EXPECT_EQ(utc_text(time, 0, minutes(-330)), "2024-02-29T17:29:59-05:30");
  EXPECT_EQ(utc_text(Time(Duration(-1)), 9), "1969-12-31T23:59:59.999999999Z");
}

RC_GTEST_PROP(UtcText, IsReadBackTheSame, ()) {
  const Time time(Duration(
      *rc::gen::inRange<std::int64_t>(-4'000'000'000'000'000'000, 4'500'000'000'000'000'000)));
  const minutes zone(*rc::gen::inRange(-840, 841));
  RC_ASSERT(utc_from_text(utc_text(time, 9, zone)) == time);
  RC_ASSERT(zone_from_text(zone_text(zone)) == zone);
}

TEST(ZoneFromText, RefusesAllElse) {
  for (const char* text : {"", "Z", "1:00", "+1:00", "+01", "+01:60", "+14:01", "+01:00x"}) {
    EXPECT_TRUE(contains(error_of([&] { zone_from_text(text); }), "offset from UTC")) << text;
  }
}

}  // namespace
}  // namespace tagfield
