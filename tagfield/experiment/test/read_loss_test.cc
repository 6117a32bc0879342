// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/internal/read_loss.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace tagfield {
namespace {

/// Two tags, each read at `rate_hz` for `seconds`.
std::vector<TagRead> reads_of(double seconds, double rate_hz) {
  std::vector<TagRead> reads;
  const auto count = static_cast<int>(seconds * rate_hz);
  for (int i = 0; i < count; ++i) {
    for (const char* tag : {"a", "b"}) {
      TagRead read;
      read.stamp = time_from_seconds(i / rate_hz);
      read.antenna = "mobile";
      read.tag = tag;
      reads.push_back(read);
    }
  }
  return reads;
}

double share_of(const std::vector<bool>& lost) {
  return static_cast<double>(std::count(lost.begin(), lost.end(), true)) /
         static_cast<double>(lost.size());
}

TEST(ReadLoss, LosesItsShareOneByOne) {
  const std::vector<TagRead> reads = reads_of(10'000.0, 5.0);
  // Five standard deviations of a share of 0.3 of 100 000 are 0.0072.
  EXPECT_NEAR(share_of(lost_reads(reads, {0.3, 0.0, 0.0}, 1)), 0.3, 0.0073);
  EXPECT_EQ(share_of(lost_reads(reads, {0.0, 0.0, 0.0}, 1)), 0.0);
  EXPECT_EQ(share_of(lost_reads(reads, {1.0, 0.0, 0.0}, 1)), 1.0);
}

TEST(ReadLoss, BurstsTakeTheShareOfAPoissonProcess) {
  // About 2000 bursts; the share of time covered is 1 − e^(−b/T).
  const std::vector<TagRead> reads = reads_of(20'000.0, 5.0);
  EXPECT_NEAR(share_of(lost_reads(reads, {0.0, 1.0, 10.0}, 3)), 1.0 - std::exp(-0.1), 0.01);
  EXPECT_NEAR(share_of(lost_reads(reads, {0.3, 1.0, 10.0}, 3)), 1.0 - 0.7 * std::exp(-0.1), 0.01);
}

TEST(ReadLoss, BurstsAreAsLongAsStated) {
  const std::vector<TagRead> reads = reads_of(20'000.0, 20.0);
  const std::vector<bool> lost = lost_reads(reads, {0.0, 2.0, 500.0}, 5);
  // Both tags are lost simultaneously, and hardly any bursts overlap.
  std::vector<int> lengths;
  int length = 0;
  for (std::size_t i = 0; i < reads.size(); i += 2) {
    ASSERT_EQ(lost[i], lost[i + 1]);
    if (lost[i]) ++length;
    if (!lost[i] && length > 0) {
      lengths.push_back(length);
      length = 0;
    }
  }
  ASSERT_GT(lengths.size(), 15U);
  EXPECT_LT(lengths.size(), 75U);
  std::sort(lengths.begin(), lengths.end());
  EXPECT_NEAR(lengths[lengths.size() / 2], 40, 1);  // 2 s at 20 Hz.
}

TEST(ReadLoss, DependsOnTheSeedAndTheReadAlone) {
  const std::vector<TagRead> reads = reads_of(500.0, 5.0);
  const ReadLoss loss{0.5, 0.0, 0.0};
  const std::vector<bool> lost = lost_reads(reads, loss, 1);
  EXPECT_EQ(lost, lost_reads(reads, loss, 1));
  EXPECT_NE(lost, lost_reads(reads, loss, 2));
  std::vector<TagRead> reversed(reads.rbegin(), reads.rend());
  std::vector<bool> lost_reversed = lost_reads(reversed, loss, 1);
  std::reverse(lost_reversed.begin(), lost_reversed.end());
  EXPECT_EQ(lost, lost_reversed);
  const std::vector<TagRead> kept = without_lost(reads, loss, 1);
  EXPECT_EQ(kept.size(), static_cast<std::size_t>(std::count(lost.begin(), lost.end(), false)));
  EXPECT_TRUE(without_lost({}, {0.3, 1.0, 10.0}, 1).empty());
}

}  // namespace
}  // namespace tagfield
