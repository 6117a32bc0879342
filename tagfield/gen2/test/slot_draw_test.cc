// SPDX-License-Identifier: Apache-2.0
#include "tagfield/gen2/internal/slot_draw.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tagfield/base/test/statistics.h"

namespace tagfield {
namespace {

std::vector<std::uint32_t> first(std::size_t count) {
  std::vector<std::uint32_t> tags(count);
  std::iota(tags.begin(), tags.end(), 0U);
  return tags;
}

RC_GTEST_PROP(SlotDraw, AFrameHasEachTagOnce, ()) {
  const auto count = static_cast<std::size_t>(*rc::gen::inRange(0, 100));
  const int slots = *rc::gen::inRange(1, 200);
  RandomStream stream(*rc::gen::arbitrary<std::uint64_t>(), Purpose::kGen2);
  std::vector<std::uint32_t> waiting = first(count);
  std::vector<std::uint32_t> repliers;
  std::vector<std::uint32_t> all;
  for (int left = slots; left > 0; --left) {
    draw_repliers(left, stream, waiting, repliers);
    all.insert(all.end(), repliers.begin(), repliers.end());
  }
  std::sort(all.begin(), all.end());
  RC_ASSERT(all == first(count));
}

// Two tags, four slots, sixteen pairs of slots: all equally frequent.
TEST(SlotDraw, TagsDrawApartFromOneAnother) {
  constexpr int kFrames = 32000;
  RandomStream stream(1, Purpose::kGen2);
  std::vector<double> counts(16, 0.0);
  std::vector<std::uint32_t> repliers;
  for (int frame = 0; frame < kFrames; ++frame) {
    std::vector<std::uint32_t> waiting = first(2);
    std::vector<std::size_t> slots(2);
    for (std::size_t slot = 0; slot < 4; ++slot) {
      draw_repliers(static_cast<std::int64_t>(4 - slot), stream, waiting, repliers);
      for (const std::uint32_t tag : repliers) slots[tag] = slot;
    }
    counts[4 * slots[0] + slots[1]] += 1.0;
  }
  double chi_squared = 0.0;
  for (const double count : counts) chi_squared += (count - 2000.0) * (count - 2000.0) / 2000.0;
  EXPECT_LT(chi_squared, 56.5);  // 15 degrees of freedom, one in a million.
}

TEST(SlotDraw, ManyTagsInFewSlotsFollowTheBinomialLaw) {
  RandomStream stream(1, Purpose::kGen2);
  std::vector<std::uint32_t> waiting = first(100'000);
  std::vector<std::uint32_t> repliers;
  draw_repliers(8, stream, waiting, repliers);
  const double deviation = static_cast<double>(repliers.size()) - 100'000 / 8.0;
  EXPECT_LT(std::abs(deviation) / std::sqrt(100'000 / 8.0 * 7.0 / 8.0), statistics::kNormalBound);
  EXPECT_EQ(repliers.size() + waiting.size(), 100'000U);
}

}  // namespace
}  // namespace tagfield
