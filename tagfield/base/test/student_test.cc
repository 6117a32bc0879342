// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/student.h"

#include <gtest/gtest.h>

#include <array>

namespace tagfield {
namespace {

TEST(Student, IsThatOfTheTables) {
  // From any table of the t distribution, column 0.975.
  constexpr std::array<std::array<double, 2>, 7> kTable = {
      {{1, 12.706}, {2, 4.303}, {3, 3.182}, {4, 2.776}, {5, 2.571}, {10, 2.228}, {30, 2.042}}};
  for (const auto& [degrees, quantile] : kTable) {
    EXPECT_NEAR(student_975(degrees), quantile, 0.01 * quantile) << degrees;
  }
  EXPECT_NEAR(student_975(1e9), 1.95996, 1e-5);
}

}  // namespace
}  // namespace tagfield
