// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/range_check.h"

#include <gtest/gtest.h>

#include <limits>

#include "tagfield/base/test/error_text.h"

namespace tagfield {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const std::string kNoError = "(no error)";

TEST(RequireInRange, TakesItsEndsAndNothingBeyond) {
  const auto said = [](double value) {
    return error_of([&] { require_in_range("share", value, 0.25, 1e9); });
  };
  EXPECT_EQ(said(0.25), kNoError);
  EXPECT_EQ(said(1e9), kNoError);
  EXPECT_EQ(said(0.2), "share must be from 0.25 to 1e+09, is 0.2");
  EXPECT_EQ(said(kInfinity), "share must be from 0.25 to 1e+09, is inf");
  EXPECT_EQ(said(kNan), "share must be from 0.25 to 1e+09, is nan");
}

TEST(RequireInRange, NamesTheUnit) {
  EXPECT_EQ(error_of([] { require_in_range("dwell", 0.5, 1.0, 4.0, "s"); }),
            "dwell must be from 1 to 4 s, is 0.5");
}

TEST(RequirePositive, RefusesZeroAndWhatIsNotFinite) {
  const auto said = [](double value) { return error_of([&] { require_positive("rate", value); }); };
  EXPECT_EQ(said(1e-300), kNoError);
  EXPECT_EQ(said(0.0), "rate must be a finite number greater than 0, is 0");
  EXPECT_EQ(said(kInfinity), "rate must be a finite number greater than 0, is inf");
  EXPECT_EQ(said(kNan), "rate must be a finite number greater than 0, is nan");
}

TEST(RequireNotNegative, TakesZero) {
  const auto said = [](double value) {
    return error_of([&] { require_not_negative("noise", value); });
  };
  EXPECT_EQ(said(0.0), kNoError);
  EXPECT_EQ(said(-1e-300), "noise must be a finite number, 0 or more, is -1e-300");
  EXPECT_EQ(said(kInfinity), "noise must be a finite number, 0 or more, is inf");
  EXPECT_EQ(said(kNan), "noise must be a finite number, 0 or more, is nan");
}

}  // namespace
}  // namespace tagfield
