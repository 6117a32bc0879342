// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/error.h"

#include <gtest/gtest.h>

#include "tagfield/base/test/error_text.h"

namespace tagfield {
namespace {

using Lines = std::vector<std::string>;

TEST(Location, IsFileAndLineAsFarAsKnown) {
  EXPECT_EQ(to_string(Location{"a.csv", 3}), "a.csv:3");
  EXPECT_EQ(to_string(Location{"a.csv", 0}), "a.csv");
  EXPECT_EQ(to_string(Location{"a.csv", -1}), "a.csv");
  EXPECT_EQ(to_string(Location{"", 3}), "");
}

TEST(Fail, PutsThePlaceFirst) {
  EXPECT_EQ(error_of([] { fail({"a.csv", 3}, "is odd"); }), "a.csv:3: is odd");
  EXPECT_EQ(error_of([] { fail({"a.csv", 0}, "is odd"); }), "a.csv: is odd");
  EXPECT_EQ(error_of([] { fail({}, "is odd"); }), "is odd");
}

TEST(Diagnostics, BeginEmpty) { EXPECT_TRUE(Diagnostics().warnings().empty()); }

TEST(Diagnostics, KeepTheOrderAndEachOnce) {
  Diagnostics diagnostics;
  diagnostics.warn("b");
  diagnostics.warn("a");
  diagnostics.warn("b");
  EXPECT_EQ(diagnostics.warnings(), (Lines{"b", "a"}));
}

TEST(Diagnostics, TellPlacesApart) {
  Diagnostics diagnostics;
  diagnostics.warn({"w.sdf", 1}, "odd");
  diagnostics.warn({"w.sdf", 2}, "odd");
  diagnostics.warn({"w.sdf", 1}, "odd");
  EXPECT_EQ(diagnostics.warnings(), (Lines{"w.sdf:1: odd", "w.sdf:2: odd"}));
}

TEST(AlikeAsOne, CountsThreeAndMore) {
  const Lines all = {"a.yaml:3: antennas[0].gain is odd",
                     "a.yaml:9: tags[1] is odd",
                     "a.yaml:5: antennas[1].gain is odd",
                     "no line at all",
                     "no line at all",
                     "a.yaml:7: antennas[12].gain is odd",
                     "a.yaml:10: tags[2] is odd"};
  EXPECT_EQ(alike_as_one(all),
            (Lines{"a.yaml:3: antennas[0].gain is odd (and 2 more like it, to line 7)",
                   "a.yaml:9: tags[1] is odd", "no line at all", "no line at all",
                   "a.yaml:10: tags[2] is odd"}));
}

TEST(AsOneLine, EscapesWhatATerminalWouldObey) {
  EXPECT_EQ(as_one_line("tag 'a\nb\t\x1b[31m\x7f' ü"), "tag 'a\\nb\\t\\x1b[31m\\x7f' ü");
  EXPECT_STREQ(Error("one\ntwo").what(), "one\\ntwo");
  Diagnostics diagnostics;
  diagnostics.warn("one\ntwo");
  EXPECT_EQ(diagnostics.warnings().at(0), "one\\ntwo");
}

TEST(AsOneLine, LeavesOutTheMiddleOfWhatIsTooLong) {
  EXPECT_EQ(as_one_line(std::string(4000, 'x')), std::string(4000, 'x'));
  const std::string cut = as_one_line("begin" + std::string(10'000'000, 'x') + "end");
  EXPECT_LT(cut.size(), 4010U);
  EXPECT_EQ(cut.substr(0, 6), "beginx");
  EXPECT_EQ(cut.substr(cut.size() - 4), "xend");
  EXPECT_NE(cut.find("x … x"), std::string::npos);
  // No character is split: "ü" has two bytes, and each cut would fall between them.
  std::string odd = "x";
  for (int i = 0; i < 3000; ++i) odd += "ü";
  const std::string whole = as_one_line(odd);
  for (std::size_t i = 1; i + 1 < whole.size(); ++i) {
    if (whole[i] == '\xBC') {
      EXPECT_EQ(whole[i - 1], '\xC3');
    }
  }
}

}  // namespace
}  // namespace tagfield
