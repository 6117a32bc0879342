// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/internal/weighed_share.h"

#include <gtest/gtest.h>

namespace tagfield {
namespace {

// By hand: what was spent over that and what is left at the mean times so far.
TEST(WeighedShare, WeighsKindsByTheirTime) {
  WeighedShare<char> share;
  for (const char kind : {'s', 's', 's', 'q', 'q', 'q'}) share.expect(kind);
  EXPECT_EQ(share.done(), 0.0);
  share.finish('s', 8.0);
  EXPECT_DOUBLE_EQ(share.done(), 8.0 / (8.0 + 5.0 * 8.0));  // The quick ones are not known yet.
  share.finish('q', 1.0);
  EXPECT_DOUBLE_EQ(share.done(), 9.0 / (9.0 + 2.0 * 8.0 + 2.0 * 1.0));
  share.finish('s', 10.0);
  EXPECT_DOUBLE_EQ(share.done(), 19.0 / (19.0 + 9.0 + 2.0));
  share.finish('q', 1.0);
  share.finish('q', 1.0);
  EXPECT_DOUBLE_EQ(share.done(), 21.0 / (21.0 + 9.0));
  share.finish('s', 9.0);
  EXPECT_EQ(share.done(), 1.0);
}

TEST(WeighedShare, LeavesOutWhatHadBeenDoneBefore) {
  WeighedShare<int> share;
  EXPECT_EQ(share.done(), 1.0);
  for (int kind = 0; kind < 4; ++kind) share.expect(kind);
  share.finish(0, std::nullopt);
  EXPECT_EQ(share.done(), 0.0);
  share.finish(1, 2.0);
  EXPECT_DOUBLE_EQ(share.done(), 1.0 / 3.0);
  share.finish(2, std::nullopt);
  share.finish(3, std::nullopt);
  EXPECT_EQ(share.done(), 1.0);
}

}  // namespace
}  // namespace tagfield
