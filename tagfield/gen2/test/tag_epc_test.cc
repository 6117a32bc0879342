// SPDX-License-Identifier: Apache-2.0
#include "tagfield/gen2/tag_epc.h"

#include <gtest/gtest.h>

namespace tagfield {
namespace {

TEST(TagEpc, HexadecimalIdsAreTheEpcItself) {
  EXPECT_EQ(epc_of_id("3074257bf7194e4000001a85"),
            (Words{0x3074, 0x257b, 0xf719, 0x4e40, 0x0000, 0x1a85}));
  EXPECT_EQ(to_hex(epc_of_id("3074257BF7194E4000001A85")), "3074257BF7194E4000001A85");
  EXPECT_EQ(epc_of_id("cafe"), (Words{0xcafe}));
}

/// The example of the Tag Data Standard.
TEST(TagEpc, UrisHaveTheirBits) {
  EXPECT_EQ(to_hex(epc_of_id("urn:epc:tag:sgtin-96:3.0614141.812345.6789")),
            "3074257BF7194E4000001A85");
}

TEST(TagEpc, ShortIdsAreTheirBytes) {
  EXPECT_EQ(epc_of_id("tag_1"), (Words{0x7461, 0x675f, 0x3100, 0, 0, 0}));
  EXPECT_EQ(to_hex(epc_of_id("parcel_00012")), "70617263656C5F3030303132");
}

/// As their ASCII bytes, zero-padded to a whole word.
TEST(TagEpc, LongerIdsAreTheirBytesToo) {
  EXPECT_EQ(to_hex(epc_of_id("a longer name")), "61206C6F6E676572206E616D6500");
  EXPECT_EQ(epc_of_id(std::string(62, 'x')), Words(31, 0x7878));
}

TEST(TagEpc, IdsBeyondATagsRoomHaveAHashEach) {
  const std::string name(62, 'x');
  const Words one = epc_of_id(name + "1");
  EXPECT_EQ(one.size(), 6U);
  EXPECT_EQ(one, epc_of_id(name + "1"));
  EXPECT_NE(one, epc_of_id(name + "2"));
  EXPECT_EQ(epc_of_id(std::string(128, 'A')).size(), 6U);
}

}  // namespace
}  // namespace tagfield
