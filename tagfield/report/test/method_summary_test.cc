// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/method_summary.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tagfield/report/internal/tables.h"
#include "tagfield/report/test/balanced_tags.h"
#include "tagfield/report/test/text_holds.h"

namespace tagfield {
namespace {

const std::vector<Eigen::Vector3d> kPlaces = {
    {4.58, -6.4, 1.25}, {4.58, 3.4, 1.75}, {-4.58, 0.0, 1.25}, {1.0, 2.0, 0.5}};

/// Outcomes of a seed, with each tag's estimate computed by `estimate`.
template <typename Estimate>
std::vector<TagOutcome> outcomes_of(std::uint64_t seed, Estimate estimate) {
  std::vector<TagOutcome> outcomes;
  for (std::size_t i = 0; i < kPlaces.size(); ++i) {
    TagOutcome outcome;
    outcome.seed = seed;
    outcome.truth_m = kPlaces[i];
    outcome.estimate = {
        "t" + std::to_string(i), Verdict::kLocated, "", {{estimate(kPlaces[i]), 0.01, 0.01}}, 100};
    outcomes.push_back(outcome);
  }
  return outcomes;
}

/// Rotated by `yaw` and shifted, as by a global pose error.
auto moved(double yaw, double x, double y) {
  return [=](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(std::cos(yaw) * p.x() - std::sin(yaw) * p.y() + x,
                           std::sin(yaw) * p.x() + std::cos(yaw) * p.y() + y, p.z());
  };
}

TEST(AlignedErrors, AreWithoutEachSeedsShiftAndTurn) {
  std::vector<TagOutcome> outcomes = outcomes_of(1, moved(0.02, 0.3, -0.1));
  const auto second = outcomes_of(2, moved(-0.01, -0.2, 0.5));
  outcomes.insert(outcomes.end(), second.begin(), second.end());
  const std::vector<double> errors = aligned_errors(outcomes);
  ASSERT_EQ(errors.size(), 2 * kPlaces.size());
  for (const double error : errors) EXPECT_NEAR(error, 0.0, 1e-12);
}

TEST(AlignedErrors, KeepTheErrorInHeight) {
  const auto errors =
      aligned_errors(outcomes_of(1, [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
        return p + Eigen::Vector3d(0.5, 0.0, 0.04);
      }));
  ASSERT_EQ(errors.size(), kPlaces.size());
  for (const double error : errors) EXPECT_NEAR(error, 0.04, 1e-12);
}

TEST(AlignedErrors, NeedThreeTagsOfASeed) {
  auto outcomes = outcomes_of(1, moved(0.0, 0.1, 0.0));
  outcomes[0].estimate.verdict = Verdict::kAmbiguous;
  EXPECT_EQ(aligned_errors(outcomes).size(), 3u);
  outcomes[1].reference = true;
  EXPECT_TRUE(aligned_errors(outcomes).empty());
}

TEST(SummaryOfMethod, CountsAndAligns) {
  auto outcomes = outcomes_of(1, moved(0.0, 0.3, 0.4));
  outcomes[0].estimate.verdict = Verdict::kNotLocated;
  const MethodSummary summary = summary_of_method("joint", outcomes, true);
  EXPECT_EQ(summary.method, "joint");
  EXPECT_EQ(summary.located, 3u);
  EXPECT_EQ(summary.not_located, 1u);
  ASSERT_TRUE(summary.error_m && summary.aligned_error_m);
  EXPECT_NEAR(summary.error_m->mean, 0.5, 1e-12);
  EXPECT_NEAR(summary.aligned_error_m->max, 0.0, 1e-12);
  EXPECT_FALSE(summary_of_method("joint", outcomes, false).aligned_error_m);
}

TEST(SummaryOfMethod, LeavesOutReferenceTags) {
  auto outcomes = outcomes_of(1, moved(0.0, 0.3, 0.4));
  outcomes[0].reference = true;
  EXPECT_EQ(summary_of_method("joint", outcomes, false).located, 3u);
}

TEST(MethodsTable, HasARowAMethod) {
  Summary summary;
  EXPECT_EQ(methods_table(summary), "");
  const auto outcomes = outcomes_of(1, moved(0.0, 0.3, 0.4));
  summary.compared_methods = {summary_of_method("joint", outcomes, false),
                              summary_of_method("<odd>", {}, false)};
  const std::string html = methods_table(summary);
  EXPECT_EQ(unbalanced_tag(html), "");
  EXPECT_TRUE(holds(html, "<th scope=\"row\">joint</th><td>4 of 4</td><td>0</td><td>500.0</td>"));
  EXPECT_TRUE(holds(html, "&lt;odd&gt;"));
  EXPECT_FALSE(holds(html, "rigid"));
  summary.compared_methods[0] = summary_of_method("joint", outcomes, true);
  EXPECT_TRUE(holds(methods_table(summary), "After the best rigid alignment"));
}

}  // namespace
}  // namespace tagfield
