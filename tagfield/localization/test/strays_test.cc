// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/strays.h"

#include <gtest/gtest.h>

namespace tagfield {
namespace {

Time at(double seconds) { return time_from_seconds(seconds); }

/// `count` rows, a tenth of a second apart.
std::vector<Time> rows(int count, double begin_s) {
  std::vector<Time> stamps;
  stamps.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    stamps.push_back(at(begin_s) + std::chrono::milliseconds(100 * i));
  return stamps;
}

std::vector<Time> with(std::vector<Time> stamps, const std::vector<Time>& more) {
  stamps.insert(stamps.begin() + static_cast<std::ptrdiff_t>(stamps.size() / 2), more.begin(),
                more.end());
  return stamps;
}

void expect_range(const std::vector<Time>& stamps, Time begin, Time end) {
  const StampRange range = range_without_strays(stamps);
  EXPECT_EQ(range.begin, begin);
  EXPECT_EQ(range.end, end);
}

TEST(Strays, AreRowsOfAnotherEpoch) {
  const auto good = rows(200, 1.7e9);
  expect_range(good, good.front(), good.back());
  expect_range(with(good, {at(0.0)}), good.front(), good.back());
  expect_range(with(good, {at(4.5e9)}), good.front(), good.back());
  expect_range(with(good, {at(-4.5e9), at(4.5e9)}), good.front(), good.back());
  expect_range(with(good, {at(0.0), at(0.2)}), good.front(), good.back());
}

TEST(Strays, AreAnHourOffAtLeast) {
  const auto good = rows(200, 1.7e9);
  expect_range(with(good, {good.back() + std::chrono::minutes(59)}), good.front(),
               good.back() + std::chrono::minutes(59));
  expect_range(with(good, {good.back() + std::chrono::minutes(61)}), good.front(), good.back());
}

TEST(Strays, AreFurtherOffThanTheOthersLast) {
  std::vector<Time> slow;
  slow.reserve(200);
  for (int i = 0; i < 200; ++i) slow.push_back(at(60.0 * i));  // 3 h 20 min.
  expect_range(with(slow, {at(5.0 * 3600.0)}), at(0.0), at(5.0 * 3600.0));
  expect_range(with(slow, {at(7.0 * 3600.0)}), at(0.0), slow.back());
}

TEST(Strays, AreNotRowsThatMayLocateATag) {
  const auto good = rows(2000, 1.7e9);
  expect_range(with(good, rows(7, 0.0)), good.front(), good.back());
  expect_range(with(good, rows(8, 0.0)), at(0.0), good.back());
  const auto few = rows(99, 1.7e9);
  expect_range(with(few, {at(0.0), at(0.1)}), at(0.0), few.back());
  expect_range(with(few, {at(0.0)}), few.front(), few.back());
  expect_range(with(rows(7, 1.7e9), {at(0.0)}), at(0.0), rows(7, 1.7e9).back());
  expect_range(rows(1, 5.0), at(5.0), at(5.0));
}

TEST(Strays, AreNoneWhereWorkPausesForADay) {
  const auto first = rows(500, 0.0);
  const auto second = rows(500, 86400.0);
  expect_range(with(first, second), first.front(), second.back());
}

}  // namespace
}  // namespace tagfield
