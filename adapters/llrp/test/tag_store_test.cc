// SPDX-License-Identifier: Apache-2.0
#include "adapters/llrp/tag_store.h"

#include <gtest/gtest.h>

namespace tagfield::llrp {
namespace {

MemoryMask epc_starts(std::uint8_t byte) {
  MemoryMask mask;
  mask.bank = 1;
  mask.pointer = 32;
  mask.count = 8;
  mask.data = {byte};
  return mask;
}

/// The six state-unaware actions (§15.2.1.2.1.3), for a tag that matches and for one that does not.
TEST(TagStore, FiltersSelectAndUnselect) {
  const MemoryBanks matching({0xaa00});
  const MemoryBanks other({0xbb00});
  const bool expected[6][2] = {{true, false}, {true, false}, {true, false},
                               {false, true}, {false, true}, {false, true}};
  for (std::uint8_t action = 0; action < 6; ++action) {
    const std::vector<TagFilter> filters = {{epc_starts(0xaa), action}};
    EXPECT_EQ(is_selected(filters, matching), expected[action][0]) << int{action};
    EXPECT_EQ(is_selected(filters, other), expected[action][1]) << int{action};
  }
  EXPECT_TRUE(is_selected({}, other));
  // Several filters combine.
  EXPECT_TRUE(is_selected({{epc_starts(0xaa), 1}, {epc_starts(0xbb), 1}}, other));
  EXPECT_FALSE(is_selected({{epc_starts(0xaa), 1}, {epc_starts(0xaa), 3}}, matching));
}

TEST(TagStore, TargetsAreThoseThatMatchOrThoseThatDoNot) {
  const MemoryBanks tag({0xaa00});
  MemoryMask mask = epc_starts(0xaa);
  EXPECT_TRUE(is_meant(mask, tag));
  mask.match = false;
  EXPECT_FALSE(is_meant(mask, tag));
  mask.count = 0;
  mask.match = true;
  EXPECT_TRUE(is_meant(mask, tag));
}

TEST(TagStore, ATagKeepsItsMemory) {
  TagStore store;
  EXPECT_EQ(store.of("cafe").epc(), (Words{0xcafe}));
  store.of("cafe").write(0, Bank::kUser, 0, {7});
  Words words;
  store.of("cafe").read(0, Bank::kUser, 0, 1, words);
  EXPECT_EQ(words, (Words{7}));
}

}  // namespace
}  // namespace tagfield::llrp
