// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/internal/tables.h"

#include <gtest/gtest.h>

#include "tagfield/report/test/balanced_tags.h"
#include "tagfield/report/test/run_folder.h"
#include "tagfield/report/test/text_holds.h"

namespace tagfield {
namespace {

TEST(TagTable, HoldsEstimateAndError) {
  const std::string html = tag_table(summary_of({}));
  EXPECT_EQ(unbalanced_tag(html), "");
  EXPECT_TRUE(holds(html, "<td>4.010</td>"));
  EXPECT_TRUE(holds(html, "<td>10.0</td>"));
  EXPECT_LT(html.find("tag2"), html.find("tag10"));
  EXPECT_FALSE(holds(html, "Remark"));
}

TEST(TagTable, SaysWhyATagIsNotLocated) {
  Summary summary = summary_of({});
  summary.tags[0].estimate = {"tag1", Verdict::kNotLocated, "too few <reads>", {}, 3};
  const std::string html = tag_table(summary);
  EXPECT_TRUE(holds(html, "too few &lt;reads&gt;"));
  EXPECT_TRUE(holds(html, "not located"));
}

TEST(TagTable, OfSeveralSeedsHoldsStatistics) {
  FolderPlan plan;
  plan.seeds = {1, 2, 3};
  const std::string html = tag_table(summary_of(plan));
  EXPECT_EQ(unbalanced_tag(html), "");
  EXPECT_TRUE(holds(html, "3 of 3"));
}

TEST(TagTable, NamesReferenceTagsWithoutErrors) {
  FolderPlan plan;
  for (const std::vector<std::uint64_t>& seeds : {std::vector<std::uint64_t>{1}, {1, 2}}) {
    plan.seeds = seeds;
    Summary summary = summary_of(plan);
    const std::string before = tag_table(summary);
    for (TagOutcome& tag : summary.tags) tag.reference = true;
    const std::string html = tag_table(summary);
    EXPECT_FALSE(holds(before, ">reference<"));
    EXPECT_TRUE(holds(html, ">reference<"));
    EXPECT_FALSE(holds(html, ">located<"));
    EXPECT_FALSE(holds(html, "of 2"));
    // No estimate, so no error of one either.
    EXPECT_FALSE(holds(html, "<td>10.0</td>"));
    EXPECT_FALSE(holds(html, "<td>0.0</td>"));
  }
}

TEST(TagTable, HoldsNoErrorsThatAMethodDoesNotState) {
  Summary summary = summary_of({});
  for (TagOutcome& tag : summary.tags) {
    tag.estimate.candidates.front().rms_m = 0.0;
    tag.estimate.candidates.front().expected_error_m = 0.0;
  }
  EXPECT_FALSE(holds(tag_table(summary), "<td>0.0</td>"));
}

TEST(TagTable, StopsAtManyTags) {
  FolderPlan plan;
  plan.tags = many_tags(2000);
  const std::string html = tag_table(summary_of(plan));
  EXPECT_TRUE(holds(html, "The first 500 of 2,000 tags"));
  EXPECT_FALSE(holds(html, ">t500<"));
}

TEST(TagTable, OfNothingSaysSo) { EXPECT_TRUE(holds(tag_table({}), "No tag")); }

}  // namespace
}  // namespace tagfield
