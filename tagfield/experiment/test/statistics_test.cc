// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/internal/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace tagfield {
namespace {

TagRecord located(double error, double bound_mean, double bound_variance) {
  TagRecord tag;
  tag.verdict = Verdict::kLocated;
  tag.error = error;
  tag.bound = TagBound{bound_mean, bound_variance};
  return tag;
}

TagRecord ambiguous(double nearest) {
  TagRecord tag;
  tag.verdict = Verdict::kAmbiguous;
  tag.nearest_candidate = nearest;
  return tag;
}

BenchEntry some_entry() {
  MethodRun first;
  first.seed = 1;
  first.method = "joint";
  first.bound = BoundKind::kJoint;
  first.tags = {located(0.03, 0.01, 0.0002), located(0.4, 0.02, 0.0003), ambiguous(0.05)};
  first.seconds = 0.3;
  first.tags_given = 3;
  MethodRun second = first;
  second.seed = 2;
  second.method = "hyperbola";
  second.bound = BoundKind::kSingle;
  second.tags = {TagRecord{}, located(0.05, 0.03, 0.0005), ambiguous(0.2)};
  second.seconds = 0.6;
  return {"hall", "auto", "auto", {first, second}};
}

TEST(Statistics, CountVerdicts) {
  const EntryStatistics all = statistics_of(some_entry());
  EXPECT_EQ(all.runs, 2U);
  EXPECT_EQ(all.tags, 6U);
  EXPECT_EQ(all.located, 3U);
  EXPECT_EQ(all.ambiguous, 2U);
  EXPECT_EQ(all.not_located, 1U);
  EXPECT_EQ(all.wrong, 1U);
  EXPECT_EQ(all.candidate_hits, 1U);
  ASSERT_TRUE(all.nearest_candidate_m);
  EXPECT_NEAR(all.nearest_candidate_m->mean, 0.125, 1e-12);
}

TEST(Statistics, ErrorsAreOfLocatedTags) {
  const EntryStatistics all = statistics_of(some_entry());
  ASSERT_TRUE(all.error_m);
  EXPECT_NEAR(all.error_m->mean, 0.16, 1e-12);
  EXPECT_NEAR(all.error_m->median, 0.05, 1e-12);
  EXPECT_NEAR(all.error_m->max, 0.4, 1e-12);
  EXPECT_FALSE(all.error_3d_m);
  EXPECT_FALSE(all.aligned_error_m);
  EXPECT_EQ(errors_of(some_entry()), (std::vector<double>{0.03, 0.05, 0.4}));
}

TEST(Statistics, RatioIsOfSumsOverTheSameTags) {
  BenchEntry entry = some_entry();
  const EntryStatistics all = statistics_of(entry);
  ASSERT_TRUE(all.ratio);
  EXPECT_EQ(all.ratio->count, 3U);
  EXPECT_NEAR(all.ratio->mean, 0.48 / 0.06, 1e-9);
  EXPECT_NEAR(all.ratio->rms, std::sqrt((0.0009 + 0.16 + 0.0025) / 0.001), 1e-9);
  for (MethodRun& run : entry.runs) {
    for (TagRecord& tag : run.tags) tag.bound.reset();
  }
  EXPECT_FALSE(statistics_of(entry).ratio);
}

TEST(Statistics, CountFalseClaimsAndCompareWithWhatWasExpected) {
  BenchEntry entry = some_entry();
  EXPECT_EQ(statistics_of(entry).false_claims, 0U);
  EXPECT_FALSE(statistics_of(entry).error_over_expected);  // No expected error was stated.
  entry.runs[0].tags[0].expected_error = 0.01;             // A third of 0.03.
  entry.runs[0].tags[1].expected_error = 0.1;              // A quarter of 0.4.
  entry.runs[0].tags[1].false_claim = true;
  entry.runs[1].tags[2].expected_error = 0.1;  // Ambiguous.
  const EntryStatistics all = statistics_of(entry);
  EXPECT_EQ(all.false_claims, 1U);
  EXPECT_NEAR(all.error_over_expected.value(), std::sqrt((9.0 + 16.0) / 2.0), 1e-12);
}

TEST(Statistics, SayWhatWasUsed) {
  const EntryStatistics all = statistics_of(some_entry());
  EXPECT_EQ(all.bound, "mixed");
  EXPECT_EQ(all.methods_used.at("joint"), 1U);
  EXPECT_EQ(all.methods_used.at("hyperbola"), 1U);
  ASSERT_TRUE(all.time_per_tag_ms);
  EXPECT_NEAR(*all.time_per_tag_ms, 150.0, 1e-9);  // The median of 100 and 200.
  EXPECT_FALSE(all.nees);
}

TEST(Statistics, OfNoRunsAreEmpty) {
  const EntryStatistics none = statistics_of({"hall", "auto", "auto", {}});
  EXPECT_EQ(none.tags, 0U);
  EXPECT_FALSE(none.error_m);
  EXPECT_FALSE(none.error_over_expected);
  EXPECT_FALSE(none.ratio);
  EXPECT_FALSE(none.nees);
  EXPECT_FALSE(none.time_per_tag_ms);
}

}  // namespace
}  // namespace tagfield
