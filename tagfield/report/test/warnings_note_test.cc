// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/warnings_note.h"

#include <gtest/gtest.h>

#include "tagfield/report/test/balanced_tags.h"
#include "tagfield/report/test/text_holds.h"

namespace tagfield {
namespace {

TEST(WarningsNote, IsNothingWithoutWarnings) { EXPECT_EQ(warnings_note({}), ""); }

TEST(WarningsNote, KeepsTwoOpenAndFoldsMoreUnderTheirCount) {
  const std::string open = warnings_note({"a <b>", "another thing"});
  EXPECT_FALSE(holds(open, "<details"));
  EXPECT_TRUE(holds(open, "<strong>2 warnings</strong>"));
  EXPECT_TRUE(holds(open, "<li>a &lt;b&gt;</li>"));
  const std::string folded = warnings_note({"one", "two", "three"});
  EXPECT_TRUE(
      holds(folded, "<details class=\"note\"><summary><strong>3 warnings</strong></summary>"));
  EXPECT_TRUE(holds(folded, "<li>three</li>"));
  EXPECT_EQ(unbalanced_tag(folded), "");
}

TEST(WarningsNote, MergesEqualOnes) {
  const std::string note = warnings_note({"low", "low", "low"});
  EXPECT_TRUE(holds(note, "3 warnings"));
  EXPECT_TRUE(holds(note, "<li>low <span class=\"muted\">(3 times)</span></li>"));
}

TEST(WarningsNote, MergesOnesThatDifferOnlyInWhereTheyBegin) {
  const std::string end = " belongs to model: paper and has no effect with model: multipath";
  const std::string note = warnings_note({"f.yaml:3: antennas[0].<x>" + end, "some other warning",
                                          "f.yaml:4: antennas[0].rssi_noise" + end});
  EXPECT_TRUE(holds(note, "<li>…" + end +
                              " <span class=\"muted\">(2 times: f.yaml:3: antennas[0].&lt;x&gt;; "
                              "f.yaml:4: antennas[0].rssi_noise)</span></li>"));
  EXPECT_TRUE(holds(note, "<li>some other warning</li>"));
}

TEST(WarningsNote, DoesNotMergeWhatOnlyEndsAlike) {
  const std::string note = warnings_note(
      {"the first antenna of the robot has a long name: state one", "no tag at all: state one"});
  EXPECT_FALSE(holds(note, "times"));
}

TEST(WarningsNote, SaysHowManyAreLeftOut) {
  std::vector<std::string> warnings;
  for (int i = 0; i < 53; ++i) warnings.push_back(std::to_string(i));
  const std::string note = warnings_note(warnings, "summary.json");
  EXPECT_TRUE(holds(note, "53 warnings"));
  EXPECT_TRUE(holds(note, "<li>49</li>"));
  EXPECT_FALSE(holds(note, "<li>50</li>"));
  EXPECT_TRUE(holds(note, "<li>and 3 more in summary.json</li>"));
}

}  // namespace
}  // namespace tagfield
