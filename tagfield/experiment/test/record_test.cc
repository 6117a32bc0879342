// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/internal/record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/experiment/judge.h"

namespace tagfield {
namespace {

Truth hall() {
  Truth truth;
  truth.tag_positions = {
      {Time{}, "a", {1, 2, 3}},      {Time{}, "b", {4, 5, 1}},
      {Time{}, "moving", {0, 0, 0}}, {time_from_seconds(1.0), "moving", {1, 0, 0}},
      {Time{}, "known", {7, 7, 1}},  {Time{}, "unread", {8, 8, 1}}};
  return truth;
}

TagEstimate estimate_at(const std::string& tag, const std::vector<Eigen::Vector3d>& places) {
  TagEstimate estimate;
  estimate.tag = tag;
  estimate.verdict = places.size() > 1 ? Verdict::kAmbiguous : Verdict::kLocated;
  for (const Eigen::Vector3d& p_WT : places) {
    Candidate candidate;
    candidate.p_WT = p_WT;
    candidate.expected_error_m = 0.02;
    candidate.covariance = Eigen::Vector3d(0.01, 0.01, 0.04).asDiagonal();
    estimate.candidates.push_back(candidate);
  }
  return estimate;
}

const std::vector<TagEstimate> kEstimates = {
    estimate_at("a", {{1.3, 2.4, 3.2}}), estimate_at("b", {{40, 50, 1}, {4, 5.1, 1}}),
    estimate_at("moving", {{0, 0, 0}}), estimate_at("known", {{7, 7, 1}})};

std::vector<TagRecord> records(const LocalizationProblem& problem) {
  const std::vector<std::string> order = {"a", "b", "moving", "known", "unread"};
  return records_of(
      problem, judged(with_all_tags(kEstimates, {}, order), {}, hall(), problem.reference_tags));
}

TEST(Records, PutEstimatesBesideTheTruth) {
  LocalizationProblem problem;
  problem.reference_tags["known"] = {7, 7, 1};
  const std::vector<TagRecord> tags = records(problem);
  ASSERT_EQ(tags.size(), 4U);
  EXPECT_EQ(tags[0].tag, "a");
  EXPECT_NEAR(tags[0].error.value(), 0.5, 1e-12);
  EXPECT_FALSE(tags[0].error_3d);
  EXPECT_NEAR(tags[0].nees.value().value, 25.0, 1e-9);  // (0.3² + 0.4²) / 0.01
  EXPECT_EQ(tags[0].nees->dof, 2);
  EXPECT_FALSE(tags[1].error);
  EXPECT_NEAR(tags[1].nearest_candidate.value(), 0.1, 1e-12);
  EXPECT_FALSE(tags[1].nees);
  EXPECT_EQ(tags[2].verdict, Verdict::kLocated);
  EXPECT_FALSE(tags[2].truth);
  EXPECT_FALSE(tags[2].error);
  EXPECT_EQ(tags[3].verdict, Verdict::kNotLocated);
  EXPECT_EQ(tags[3].reason, "cannot localize: never read");
}

TEST(Records, CountHeightWhereItIsEstimated) {
  LocalizationProblem problem;
  problem.heights.estimated = HeightSide::kAbove;
  const std::vector<TagRecord> tags = records(problem);
  EXPECT_NEAR(tags[0].error_3d.value(), std::sqrt(0.25 + 0.04), 1e-12);
  EXPECT_NEAR(tags[0].nees.value().value, 26.0, 1e-9);  // and 0.2² / 0.04
  EXPECT_EQ(tags[0].nees->dof, 3);
}

TEST(Records, AreJudgedByTheirBound) {
  MethodRun run;
  run.tags = records({});
  Bounds bounds;
  bounds.tags = {"a", "unread"};
  bounds.covariance = 0.0004 * Eigen::MatrixXd::Identity(6, 6);
  judge_by(bounds, run);
  ASSERT_TRUE(run.tags[0].bound);
  EXPECT_NEAR(run.tags[0].bound->variance_m2, 0.0008, 1e-12);
  // The mean of the Rayleigh distribution.
  EXPECT_NEAR(run.tags[0].bound->mean_error_m, 0.02 * std::sqrt(std::acos(-1.0) / 2.0), 1e-9);
  EXPECT_FALSE(run.tags[1].bound);
  // From "a" and the reference tag, which counts as an ordinary one here.
  EXPECT_NEAR(run.nees_correlation, 4.0, 1e-12);
}

TEST(Records, SayWhichClaimsAreFalse) {
  MethodRun run;
  run.method = "hyperbola";
  run.tags = records({});
  judge_claims({}, run);
  EXPECT_TRUE(run.tags[0].false_claim);   // Error 0.5 m, expected 0.02 m.
  EXPECT_FALSE(run.tags[1].false_claim);  // Ambiguous: no position was claimed.
  EXPECT_TRUE(run.tags[2].moved);
  EXPECT_TRUE(run.tags[2].false_claim);
  EXPECT_FALSE(run.tags[4].false_claim);
  run.tags[0].expected_error = 0.11;
  judge_claims({}, run);
  EXPECT_FALSE(run.tags[0].false_claim);
  run.tags[0].expected_error = 0.0;  // From a method that states none.
  judge_claims({}, run);
  EXPECT_FALSE(run.tags[0].false_claim);
  run.tags[0].claims_no_error = true;
  judge_claims({}, run);
  EXPECT_TRUE(run.tags[0].false_claim);  // 0.5 > 5 * 0
  run.tags[0].error = 0.0;
  judge_claims({}, run);
  EXPECT_FALSE(run.tags[0].false_claim);
  Faults faults;
  faults.random_phases = true;
  judge_claims(faults, run);
  EXPECT_TRUE(run.tags[0].false_claim);
  EXPECT_FALSE(run.tags[1].false_claim);
  run.method = "trilateration";
  judge_claims(faults, run);
  EXPECT_FALSE(run.tags[0].false_claim);
}

/// The record of a tag that is 0.5 m off the stated position.
TagRecord record_stating(double expected_error_m,
                         const std::optional<Eigen::Matrix3d>& covariance) {
  std::vector<TagEstimate> estimates = {estimate_at("a", {{1.3, 2.4, 3.0}})};
  estimates[0].candidates[0].expected_error_m = expected_error_m;
  estimates[0].candidates[0].covariance = covariance;
  return records_of({}, judged(estimates, {}, hall(), {})).at(0);
}

TEST(Records, TellAStatedErrorOf0FromNone) {
  const Eigen::Matrix3d zero = Eigen::Matrix3d::Zero();
  EXPECT_FALSE(record_stating(0.0, std::nullopt).claims_no_error);
  EXPECT_FALSE(record_stating(0.0, std::nullopt).flat_covariance);
  EXPECT_TRUE(record_stating(0.0, zero).claims_no_error);
  EXPECT_FALSE(record_stating(0.0, zero).flat_covariance);  // That would be said twice.
  EXPECT_FALSE(record_stating(0.02, zero).claims_no_error);
  EXPECT_TRUE(record_stating(0.02, zero).flat_covariance);
  EXPECT_FALSE(record_stating(0.02, zero).nees);
  const Eigen::Matrix3d good = Eigen::Vector3d(0.01, 0.01, 0.0).asDiagonal();
  EXPECT_FALSE(record_stating(0.02, good).flat_covariance);
}

TEST(Records, AreAlignedAsAWhole) {
  const double yaw = 0.01;
  std::vector<TagRecord> tags;
  for (const Eigen::Vector3d& truth :
       {Eigen::Vector3d(5, 1, 1), Eigen::Vector3d(-4, 2, 1), Eigen::Vector3d(0, -6, 1)}) {
    TagRecord tag;
    tag.truth = truth;
    tag.estimate =
        Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * truth + Eigen::Vector3d(0.1, -0.2, 0.0);
    tag.error = (*tag.estimate - truth).head<2>().norm();
    tags.push_back(tag);
  }
  tags.emplace_back();
  add_aligned_errors(tags);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(tags[i].aligned_error.value(), 0.0, 1e-12);
  EXPECT_FALSE(tags[3].aligned_error);
  std::vector<TagRecord> two = {tags[0], tags[1]};
  two[0].aligned_error.reset();
  add_aligned_errors(two);
  EXPECT_FALSE(two[0].aligned_error);
}

}  // namespace
}  // namespace tagfield
