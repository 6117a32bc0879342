// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/judge.h"

#include <gtest/gtest.h>

namespace tagfield {
namespace {

TagEstimate located(const std::string& tag, const Eigen::Vector3d& p_WT) {
  TagEstimate estimate;
  estimate.tag = tag;
  estimate.verdict = Verdict::kLocated;
  Candidate candidate;
  candidate.p_WT = p_WT;
  estimate.candidates = {candidate};
  return estimate;
}

TagPosition seen(double seconds, const std::string& tag, double x) {
  return {time_from_seconds(seconds), tag, {x, 0.0, 0.0}};
}

TEST(Judge, ATagThatSettledHasItsLastPlaceAndOneThatMovedHasNone) {
  Truth truth;
  truth.tag_positions = {seen(0, "settled", 1.0), seen(1, "settled", 1.004), seen(0, "moved", 1.0),
                         seen(1, "moved", 1.006)};
  const auto outcomes = judged(
      {located("settled", {1, 0, 0}), located("moved", {1, 0, 0}), located("odd", {1, 0, 0})}, {},
      truth, {}, 7);
  ASSERT_EQ(outcomes.size(), 3U);
  EXPECT_EQ(outcomes[0].seed, 7U);
  EXPECT_FALSE(outcomes[0].moved);
  EXPECT_NEAR(*error_of(outcomes[0]), 0.004, 1e-12);
  EXPECT_TRUE(outcomes[1].moved);
  EXPECT_FALSE(error_of(outcomes[1]));
  EXPECT_FALSE(outcomes[2].moved);  // Nothing is known of it.
  EXPECT_FALSE(outcomes[2].truth_m);
}

TEST(Judge, AReferenceTagHasNoErrorOfItsOwn) {
  Truth truth;
  truth.tag_positions = {seen(0, "known", 1.0)};
  const auto outcomes = judged({located("known", {1.5, 0, 0})}, {}, truth, {{"known", {1, 0, 0}}});
  EXPECT_TRUE(outcomes[0].reference);
  EXPECT_FALSE(error_of(outcomes[0]));
}

TEST(Judge, TagsThatWereNeverReadAreNotLocatedAndKeepTheirOrder) {
  const auto all = with_all_tags({located("b", {0, 0, 0})}, {}, {"a", "b", "c"});
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].reason, "cannot localize: never read");
  EXPECT_EQ(all[0].verdict, Verdict::kNotLocated);
  EXPECT_EQ(all[1].verdict, Verdict::kLocated);
  EXPECT_EQ(all[2].tag, "c");
}

}  // namespace
}  // namespace tagfield
