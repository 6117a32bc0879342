// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/text.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <vector>

namespace tagfield {
namespace {

TEST(Escaped, MakesMarkupHarmless) {
  EXPECT_EQ(escaped("<script a='1' b=\"2\">&"),
            "&lt;script a=&#39;1&#39; b=&quot;2&quot;&gt;&amp;");
}

RC_GTEST_PROP(Escaped, HoldsNoMarkupWhateverTheBytes, (const std::string& bytes)) {
  const std::string safe = escaped(bytes);
  RC_ASSERT(safe.find_first_of("<>\"'") == std::string::npos);
  RC_ASSERT(std::none_of(safe.begin(), safe.end(),
                         [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }));
}

RC_GTEST_PROP(CleanText, IsItsOwnCleanText, (const std::string& bytes)) {
  RC_ASSERT(clean_text(clean_text(bytes)) == clean_text(bytes));
}

TEST(CleanText, KeepsWellFormedText) {
  EXPECT_EQ(clean_text("Tür 日本 🏷"), "Tür 日本 🏷");
}

TEST(CleanText, ReplacesWhatIsNoCharacterOfXml) {
  const std::string replacement = "\xEF\xBF\xBD";
  EXPECT_EQ(clean_text("a\x01"), "a" + replacement);
  EXPECT_EQ(clean_text("\xC3"), replacement);                       // Truncated.
  EXPECT_EQ(clean_text("\xC0\xAF"), replacement + replacement);     // Overlong.
  EXPECT_EQ(clean_text("\xED\xA0\x80").substr(0, 3), replacement);  // Surrogate.
  EXPECT_EQ(clean_text("\xEF\xBF\xBF").substr(0, 3), replacement);  // U+FFFF.
  EXPECT_EQ(clean_text("\xE2\x80\xAE"
                       "abc")
                .substr(0, 3),
            replacement);  // Right to left.
}

TEST(Shortened, KeepsBothEnds) {
  EXPECT_EQ(shortened("tag1", 10), "tag1");
  EXPECT_EQ(shortened("E28011606000020756FD7A1B", 10), "E280…D7A1B");
  EXPECT_EQ(shortened("日本語のタグ", 3), "日…グ");
}

TEST(NaturalLess, CountsAsAPersonDoes) {
  std::vector<std::string> names = {"tag10", "tag2", "Tag", "tag", "tag02", "a3b", "a3"};
  std::sort(names.begin(), names.end(), natural_less);
  EXPECT_EQ(names, (std::vector<std::string>{"Tag", "a3", "a3b", "tag", "tag02", "tag2", "tag10"}));
}

RC_GTEST_PROP(NaturalLess, IsAStrictOrder, (const std::string& a, const std::string& b)) {
  RC_ASSERT(!natural_less(a, a));
  RC_ASSERT(a == b || natural_less(a, b) != natural_less(b, a));
}

TEST(SpokenLength, SuitsItsSize) {
  EXPECT_EQ(spoken_length(0.0032), "3.2 mm");
  EXPECT_EQ(spoken_length(0.0154), "15 mm");
  EXPECT_EQ(spoken_length(1.234), "1.23 m");
}

TEST(Grouped, SetsThousandsApart) {
  EXPECT_EQ(grouped(7), "7");
  EXPECT_EQ(grouped(700), "700");
  EXPECT_EQ(grouped(7012), "7,012");
  EXPECT_EQ(grouped(1234567), "1,234,567");
}

TEST(Counted, KnowsThePlural) {
  EXPECT_EQ(counted(1, "tag"), "1 tag");
  EXPECT_EQ(counted(2000, "tag"), "2,000 tags");
}

}  // namespace
}  // namespace tagfield
