// SPDX-License-Identifier: Apache-2.0
#include "tagfield/fit/intervals.h"

#include <gtest/gtest.h>

namespace tagfield {
namespace {

TEST(IntervalsOf, AreOfOneKeyAndNotTooLong) {
  const std::vector<char> keys = {'a', 'b', 'a', 'a', 'b', 'a'};
  const std::vector<int> times = {0, 1, 2, 4, 5, 6};
  const auto found = intervals_of(
      keys.size(), [&](std::size_t i) { return keys[i]; }, [&](std::size_t i) { return times[i]; },
      3);
  // Intervals begin at the first read of each key: a at 0 and 2, then a new one at 4.
  const std::vector<ReadInterval> expected = {{0, 2}, {1}, {3, 5}, {4}};
  EXPECT_EQ(found, expected);
}

TEST(IntervalsOf, OfNothingAreNone) {
  const auto zero = [](std::size_t) { return 0; };
  EXPECT_TRUE(intervals_of(0, zero, zero, 1).empty());
}

}  // namespace
}  // namespace tagfield
