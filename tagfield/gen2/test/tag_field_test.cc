// SPDX-License-Identifier: Apache-2.0
#include "tagfield/gen2/tag_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tagfield/base/test/error_text.h"

namespace tagfield {
namespace {

TEST(TagField, FindsEachTag) {
  TagField field;
  field.assign({{7, -50.0, 1.0}, {2, -60.0, 0.5}, {9, -70.0, 0.25}});
  EXPECT_TRUE(field.has(2));
  EXPECT_FALSE(field.has(3));
  EXPECT_FALSE(field.has(1000));
  EXPECT_EQ(field.at(9).reply_dbm, -70.0);
  field.remove(7);
  field.remove(8);
  EXPECT_FALSE(field.has(7));
  EXPECT_EQ(field.at(2).reply_dbm, -60.0);
  EXPECT_EQ(field.at(9).reply_dbm, -70.0);
  field.assign({{3, -50.0, 1.0}});
  EXPECT_FALSE(field.has(9));
  EXPECT_TRUE(field.has(3));
}

TEST(TagField, BadTagsAreNamedAndChangeNothing) {
  TagField field;
  field.assign({{7, -50.0, 1.0}});
  EXPECT_EQ(error_of([&] {
              field.assign({{1, 0.0, 1.0}, {1, 0.0, 1.0}});
            }),
            "tag 1 is in the field twice");
  EXPECT_EQ(error_of([&] {
              field.assign({{4, std::nan(""), 1.0}});
            }),
            "reply_dbm of tag 4 must be finite, is nan");
  EXPECT_EQ(error_of([&] {
              field.assign({{5, 0.0, 1.5}});
            }),
            "decode_probability of tag 5 must be from 0 to 1, is 1.5");
  EXPECT_TRUE(field.has(7));
}

}  // namespace
}  // namespace tagfield
