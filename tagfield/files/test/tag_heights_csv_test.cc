// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/tag_heights_csv.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "odd_names.h"
#include "tagfield/base/test/error_text.h"
#include "tagfield/base/test/temporary_folder.h"

namespace tagfield {
namespace {

using Heights = std::map<std::string, double>;

Heights heights_of(const std::string& text) {
  const TemporaryFolder folder;
  return read_tag_heights_csv(folder.with("h.csv", text));
}

TEST(TagHeightsToCsv, WritesARowATag) {
  EXPECT_EQ(tag_heights_to_csv({{"t2", 1.85}, {"t1", 2.0}}), "tag,height_m\nt1,2\nt2,1.85\n");
  EXPECT_EQ(tag_heights_to_csv({}), "tag,height_m\n");
}

RC_GTEST_PROP(TagHeightsCsv, ReadsBackWhatItWrote, ()) {
  Heights heights;
  const auto count = *rc::gen::inRange(0, 8);
  for (int i = 0; i < count; ++i) heights[odd_name()] = 0.1 * (*rc::gen::inRange(-100, 100));
  RC_ASSERT(heights_of(tag_heights_to_csv(heights)) == heights);
}

TEST(ReadTagHeightsCsv, RefusesATagThatStandsTwice) {
  const std::string message = error_of([] { heights_of("tag,height_m\na,1\nb,2\na,1\n"); });
  EXPECT_TRUE(contains(message, "h.csv:4: tag 'a' is listed twice")) << message;
}

TEST(ReadTagHeightsCsv, NamesColumnAndLineOfBadInput) {
  EXPECT_TRUE(contains(error_of([] { heights_of("tag\na\n"); }), "h.csv:1: no column 'height_m'"));
  EXPECT_TRUE(
      contains(error_of([] { heights_of("tag,height_m\na,high\n"); }), "h.csv:2: height_m"));
  EXPECT_TRUE(
      contains(error_of([] { heights_of("tag,height_m\n,1\n"); }), "h.csv:2: tag is empty"));
}

}  // namespace
}  // namespace tagfield
