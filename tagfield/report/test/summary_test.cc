// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/summary.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tagfield/report/test/run_folder.h"

namespace tagfield {
namespace {

TEST(Statistics, AgreeWithNumPy) {
  // numpy.percentile([1, 2, 3, 4, 10], [50, 95]) = 3, 8.8.
  const auto numbers = statistics({10.0, 1.0, 4.0, 2.0, 3.0});
  ASSERT_TRUE(numbers);
  EXPECT_EQ(numbers->count, 5U);
  EXPECT_DOUBLE_EQ(numbers->mean, 4.0);
  EXPECT_DOUBLE_EQ(numbers->median, 3.0);
  EXPECT_DOUBLE_EQ(numbers->p95, 8.8);
  EXPECT_DOUBLE_EQ(numbers->max, 10.0);
  EXPECT_DOUBLE_EQ(numbers->min, 1.0);
}

TEST(Statistics, OfAnEvenNumberHaveTheMedianBetween) {
  // numpy.percentile([1, 2, 3, 6], [50, 95]) = 2.5, 5.55.
  const auto numbers = statistics({1.0, 2.0, 3.0, 6.0});
  ASSERT_TRUE(numbers);
  EXPECT_DOUBLE_EQ(numbers->median, 2.5);
  EXPECT_DOUBLE_EQ(numbers->p95, 5.55);
}

TEST(Statistics, OfOneAreThatOne) {
  const auto numbers = statistics({0.7});
  ASSERT_TRUE(numbers);
  EXPECT_DOUBLE_EQ(numbers->p95, 0.7);
}

TEST(Statistics, OfNothingAreNone) { EXPECT_FALSE(statistics({})); }

TEST(ErrorOf, IsTheDistanceInSpace) {
  TagOutcome outcome;
  outcome.truth_m = Eigen::Vector3d(1.0, 2.0, 3.0);
  outcome.estimate.verdict = Verdict::kLocated;
  outcome.estimate.candidates = {{{1.0, 2.3, 3.4}, 0.0, 0.0}};
  ASSERT_TRUE(error_of(outcome));
  EXPECT_NEAR(*error_of(outcome), 0.5, 1e-12);
}

TEST(ErrorOf, IsUnknownUnlessLocatedWithAKnownPlace) {
  TagOutcome outcome;
  outcome.estimate.candidates = {{{1.0, 2.0, 3.0}, 0.0, 0.0}};
  outcome.estimate.verdict = Verdict::kLocated;
  EXPECT_FALSE(error_of(outcome));
  outcome.truth_m = Eigen::Vector3d::Zero();
  outcome.estimate.verdict = Verdict::kAmbiguous;
  EXPECT_FALSE(error_of(outcome));
}

TEST(PositionRms, ComparesPosesOfTheSameAntennaAtTheSameTime) {
  const auto pose = [](double seconds, const char* antenna, double x, double z) {
    return AntennaPose{time_from_seconds(seconds), antenna, from_translation({x, 0.0, z})};
  };
  const std::vector<AntennaPose> b = {pose(0.0, "a", 0.0, 0.0), pose(0.0, "fixed", 9.0, 0.0),
                                      pose(2.0, "a", 2.0, 0.0)};
  // Halfway along the other, with an error of 0.3 m; after its end; the height doesn't count.
  EXPECT_NEAR(*position_rms({pose(1.0, "a", 1.3, 5.0), pose(3.0, "a", 7.0, 0.0)}, b), 0.3, 1e-12);
  EXPECT_NEAR(*position_rms({pose(0.0, "a", 0.3, 0.0), pose(2.0, "a", 2.4, 0.0)}, b),
              std::sqrt((0.09 + 0.16) / 2.0), 1e-12);
  EXPECT_FALSE(position_rms({pose(0.0, "fixed", 0.0, 0.0), pose(0.0, "other", 0.0, 0.0)}, b));
}

TEST(Count, GoesOverAllSeeds) {
  FolderPlan plan;
  plan.seeds = {1, 2};
  Summary summary = summary_of(plan);
  summary.tags.front().estimate.verdict = Verdict::kAmbiguous;
  EXPECT_EQ(count(summary, Verdict::kLocated), 5U);
  EXPECT_EQ(count(summary, Verdict::kAmbiguous), 1U);
  EXPECT_EQ(count(summary, Verdict::kNotLocated), 0U);
}

TEST(Count, LeavesOutReferenceTags) {
  FolderPlan plan;
  plan.seeds = {1, 2};
  Summary summary = summary_of(plan);
  for (const std::size_t i : {0U, 3U}) summary.tags[i].reference = true;
  EXPECT_EQ(count(summary, Verdict::kLocated), 4U);
  EXPECT_EQ(count_to_locate(summary), 4U);
}

TEST(CountOver, LeavesOutTheLimitItself) {
  Summary summary = summary_of({});
  summary.tags[0].estimate.candidates[0].p_WT.x() += 1.0;
  EXPECT_EQ(count_over(summary, 0.3), 1U);
}

}  // namespace
}  // namespace tagfield
