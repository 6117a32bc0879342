// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/internal/outlying.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "made_reads.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

using namespace made;

constexpr double kNoise = 0.1;

/// Reads on three channels with an offset each, every `every`-th of them off by π.
std::vector<PhaseLeft> reads(std::size_t count, std::size_t every, Rng& rng) {
  std::vector<PhaseLeft> left;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t channel = i % 3;
    const double stray = every > 0 && i % every == 0 ? kPi : 0.0;
    left.push_back({channel, 2.0 * static_cast<double>(channel) + stray + normal(rng, kNoise)});
  }
  return left;
}

TEST(Outlying, NamesThoseFarFromTheirChannel) {
  Rng rng(3);
  const PhaseSpread spread = spread_of(reads(300, 20, rng), kNoise);
  for (std::size_t i = 0; i < 300; ++i) {
    EXPECT_EQ(spread.outlying[i], i % 20 == 0) << i << ": " << spread.off_rad[i];
  }
}

TEST(Outlying, OfNoiseAloneHardlyAny) {
  Rng rng(4);
  const PhaseSpread spread = spread_of(reads(3000, 0, rng), kNoise);
  // 6 of 100,000 are beyond four standard deviations.
  EXPECT_LE(std::count(spread.outlying.begin(), spread.outlying.end(), true), 3);
}

TEST(Outlying, WhereManyDoNotFitItNamesNone) {
  Rng rng(5);
  const PhaseSpread spread = spread_of(reads(300, 5, rng), kNoise);
  EXPECT_EQ(std::count(spread.outlying.begin(), spread.outlying.end(), true), 0);
}

TEST(Outlying, OfNoReadsNone) { EXPECT_TRUE(spread_of({}, kNoise).outlying.empty()); }

}  // namespace
}  // namespace tagfield
