// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/number.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace tagfield {
namespace {

TEST(ParseNumber, ReadsDecimals) {
  EXPECT_EQ(parse_number("0"), 0.0);
  EXPECT_EQ(parse_number("-1.5"), -1.5);
  EXPECT_EQ(parse_number("+3"), 3.0);
  EXPECT_EQ(parse_number(".5"), 0.5);
  EXPECT_EQ(parse_number("5."), 5.0);
  EXPECT_EQ(parse_number("8.657E8"), 865.7e6);
  EXPECT_EQ(parse_number("2e-3"), 0.002);
  EXPECT_EQ(parse_number("1e-400"), 0.0);
}

TEST(ParseNumber, RefusesAllElse) {
  for (const char* text :
       {"",         ".",    "-",     "+",      "e5",    "1e",  "1e+", "--1", "+-1",
        "-+1",      "1-2",  "1 ",    " 1",     "1.2.3", "1,5", "nan", "inf", "-inf",
        "infinity", "0x10", "1e400", "-1e400", "abc",   "1f",  "١"}) {
    EXPECT_FALSE(parse_number(text).has_value()) << text;
  }
  EXPECT_FALSE(parse_number(std::string("1\0", 2)).has_value());
}

RC_GTEST_PROP(ParseNumber, ReadsBackEveryDouble, ()) {
  const double value = std::ldexp(*rc::gen::arbitrary<double>(), *rc::gen::inRange(-1000, 900));
  RC_PRE(std::isfinite(value));
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.17g", value);
  RC_ASSERT(parse_number(text.data()) == value);
}

}  // namespace
}  // namespace tagfield
