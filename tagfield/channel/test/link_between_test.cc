// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tagfield/channel/paper_model.h"

namespace tagfield {
namespace {

TEST(LinkBetween, IsTheDistance) {
  EXPECT_DOUBLE_EQ(link_between({1, 2, 3}, {3, 5, 9}).distance_m, 7.0);
  EXPECT_DOUBLE_EQ(link_between({3, 5, 9}, {1, 2, 3}).distance_m, 7.0);
  // Fixed antenna and tag 4 of the paper's example, by hand: √(0.6² + 0.82² + 0.05²).
  EXPECT_NEAR(link_between({3.5, -4.0, 2.0}, {2.90, -4.82, 2.05}).distance_m, 1.017300, 5e-7);
}

TEST(LinkBetween, IsNeverNothing) {
  EXPECT_EQ(link_between({1, 2, 3}, {1, 2, 3}).distance_m, 1e-6);
  EXPECT_EQ(link_between({0, 0, 0}, {1e-9, 0, 0}).distance_m, 1e-6);
  EXPECT_EQ(link_between({0, 0, 0}, {2e-6, 0, 0}).distance_m, 2e-6);
}

}  // namespace
}  // namespace tagfield
