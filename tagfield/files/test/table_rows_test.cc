// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/table_rows.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

namespace tagfield {
namespace {

TEST(TableRows, WritesEachKindOfCell) {
  EXPECT_EQ(csv_header({"t", {"a", "b,c"}}), "a,\"b,c\"\n");
  EXPECT_EQ(
      csv_row({Cell(), Cell(std::int64_t{-7}), Cell(0.1), Cell(std::string("x \"y\"")),
               Cell(std::numeric_limits<double>::quiet_NaN()), Cell(std::optional<double>())}),
      ",-7,0.1,\"x \"\"y\"\"\",,\n");
  EXPECT_EQ(csv_row({}), "\n");
}

/// strtod is an independent parser of numbers.
RC_GTEST_PROP(TableRows, NumbersAreReadBackToTheLastBit, (double number)) {
  RC_PRE(std::isfinite(number));
  RC_ASSERT(std::strtod(csv_row({Cell(number)}).c_str(), nullptr) == number);
}

}  // namespace
}  // namespace tagfield
