// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/map_error.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace tagfield {
namespace {

constexpr double kSigma_m = 0.02;
constexpr double kSigma_rad = 0.01;

LocalizationProblem problem_on_a_map() {
  LocalizationProblem problem;
  problem.map_error.emplace();
  problem.map_error->origin_W = Eigen::Vector2d(1.0, -2.0);
  problem.map_error->covariance.diagonal() << kSigma_m * kSigma_m, kSigma_m * kSigma_m,
      kSigma_rad * kSigma_rad;
  return problem;
}

LocalizationResult located_at(const Eigen::Vector3d& place, double sigma_m) {
  Candidate candidate;
  candidate.p_WT = place;
  candidate.expected_error_m = std::sqrt(2.0) * sigma_m;
  candidate.covariance = Eigen::Matrix3d::Zero();
  candidate.covariance->topLeftCorner<2, 2>().diagonal().setConstant(sigma_m * sigma_m);
  LocalizationResult result;
  result.method = "ml";
  result.estimates = {{"tag", Verdict::kLocated, "", {candidate}, 100}};
  return result;
}

// Compared with a thousand shifted and rotated maps, with independent position errors: the mean
// square of a thousand is within 5 standard deviations √(2/1000), so within a quarter.
TEST(MapError, IsAsFarAsMapsThatAreShiftedAndTurnedTakeAPlace) {
  const Eigen::Vector3d place(6.0, 5.0, 1.0);
  LocalizationResult result = located_at(place, 0.005);
  add_map_error(problem_on_a_map(), result);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const Eigen::Vector2d arm = place.head<2>() - Eigen::Vector2d(1.0, -2.0);
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  constexpr int kMaps = 1000;
  for (int i = 0; i < kMaps; ++i) {
    const Eigen::Vector2d shift(kSigma_m * normal(random), kSigma_m * normal(random));
    const Eigen::Vector2d own(0.005 * normal(random), 0.005 * normal(random));
    const Eigen::Rotation2Dd turn(kSigma_rad * normal(random));
    const Eigen::Vector2d off = shift + turn * arm - arm + own;
    squares += off * off.transpose() / kMaps;
  }
  const Candidate& best = result.estimates.front().candidates.front();
  const Eigen::Matrix2d covariance = best.covariance->topLeftCorner<2, 2>();
  EXPECT_NEAR(covariance(0, 0), squares(0, 0), 0.25 * squares(0, 0));
  EXPECT_NEAR(covariance(1, 1), squares(1, 1), 0.25 * squares(1, 1));
  EXPECT_NEAR(covariance(0, 1), squares(0, 1), 0.25 * std::sqrt(squares(0, 0) * squares(1, 1)));
  EXPECT_LT(covariance(0, 1), -1e-3);  // The arm is slanted.
  EXPECT_NEAR(best.expected_error_m, std::sqrt(covariance.trace()), 1e-12);
}

TEST(MapError, APlaceThatIsNoLongerSureEnoughIsNotLocated) {
  LocalizationProblem problem = problem_on_a_map();
  LocalizationResult near = located_at({1.0, -1.0, 1.0}, 0.005);
  LocalizationResult far = located_at({31.0, -2.0, 1.0}, 0.005);  // 30 m by 10 mrad
  add_map_error(problem, near);
  add_map_error(problem, far);
  EXPECT_EQ(near.estimates.front().verdict, Verdict::kLocated);
  EXPECT_EQ(far.estimates.front().verdict, Verdict::kNotLocated);
}

TEST(MapError, ReferenceTagsHoldTheMapForJoint) {
  LocalizationProblem problem = problem_on_a_map();
  problem.reference_tags["other"] = {0.0, 0.0, 0.0};
  LocalizationResult joint = located_at({6.0, 5.0, 1.0}, 0.005);
  LocalizationResult single = joint;
  joint.method = "joint";
  add_map_error(problem, joint);
  add_map_error(problem, single);
  EXPECT_DOUBLE_EQ(joint.estimates.front().candidates.front().expected_error_m,
                   std::sqrt(2.0) * 0.005);
  EXPECT_GT(single.estimates.front().candidates.front().expected_error_m, 0.05);
}

}  // namespace
}  // namespace tagfield
