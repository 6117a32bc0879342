// SPDX-License-Identifier: Apache-2.0
#include "tagfield/fit/stretches.h"

#include <gtest/gtest.h>

namespace tagfield {
namespace {

TEST(StretchesOf, AreOfOneKeyAndNotTooLong) {
  const std::vector<char> keys = {'a', 'b', 'a', 'a', 'b', 'a'};
  const std::vector<int> times = {0, 1, 2, 4, 5, 6};
  const auto found = stretches_of(
      keys.size(), [&](std::size_t i) { return keys[i]; }, [&](std::size_t i) { return times[i]; },
      3);
  // From the first read of each on: a at 0 and 2, then anew at 4.
  const std::vector<ReadStretch> expected = {{0, 2}, {1}, {3, 5}, {4}};
  EXPECT_EQ(found, expected);
}

TEST(StretchesOf, OfNothingAreNone) {
  const auto zero = [](std::size_t) { return 0; };
  EXPECT_TRUE(stretches_of(0, zero, zero, 1).empty());
}

}  // namespace
}  // namespace tagfield
