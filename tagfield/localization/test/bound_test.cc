// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/bound.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tagfield/base/units.h"
#include "tagfield/localization/test/problem_of.h"

namespace tagfield {
namespace {

using made::Path;

constexpr double kWavenumber = 2.0 * kTwoPi * 865.7e6 / kSpeedOfLight;

BoundInput input_of(const made::Hall& hall, double noise = 0.1) {
  BoundInput input;
  input.truth = hall.problem;
  input.places = hall.truth;
  input.phase_noise_rad["a"] = noise;
  return input;
}

made::Hall hall_on_true_poses(int tags, double pose_sigma, unsigned seed) {
  made::Rng rng(seed);
  const Path path = made::s_curve(8.0, 0.04);
  made::Noise noise;
  made::Hall hall = made::hall(path, path, tags, noise, rng);
  hall.problem.pose_error = PoseErrorModel{pose_sigma, 0.0, 5.0};
  return hall;
}

/// Covariance of the positions from the marginal covariance of the reads, without knots: R = σ² I +
/// G K Gᵀ with the process' covariance K between all reads, and offsets as unknowns.
Eigen::MatrixXd brute_force_covariance(const BoundInput& input) {
  std::vector<const PhaseSample*> reads;
  std::vector<int> tag_of;
  std::vector<Eigen::Vector3d> places;
  for (const auto& [tag, samples] : input.truth.samples) {
    for (const PhaseSample& sample : samples.at("a")) {
      reads.push_back(&sample);
      tag_of.push_back(static_cast<int>(places.size()));
    }
    places.push_back(input.places.at(tag));
  }
  const auto n = static_cast<Eigen::Index>(reads.size());
  const auto tags = static_cast<Eigen::Index>(places.size());
  const PoseErrorModel& model = *input.truth.pose_error;
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(n, 3 * tags);  // x, y and offset of each tag.
  Eigen::MatrixXd R(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Eigen::Index tag = tag_of[at];
    const Eigen::Vector2d u =
        (places[static_cast<std::size_t>(tag)] - reads[at]->p_WA).head<2>().normalized();
    J.block<1, 2>(i, 3 * tag) = u.transpose();
    J(i, 3 * tag + 2) = 1.0;
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto other = static_cast<std::size_t>(j);
      const Eigen::Vector2d v =
          (places[static_cast<std::size_t>(tag_of[other])] - reads[other]->p_WA)
              .head<2>()
              .normalized();
      const double apart = std::abs(to_seconds(reads[at]->stamp - reads[other]->stamp));
      R(i, j) = u.dot(v) * model.sigma_m * model.sigma_m * std::exp(-apart / model.time_constant_s);
    }
    const double noise = input.phase_noise_rad.at("a") / kWavenumber;
    R(i, i) += noise * noise;
  }
  return (J.transpose() * R.ldlt().solve(J)).inverse();
}

TEST(Bound, OfTruePoseIsTheInverseOfTheInformation) {
  const BoundInput input = input_of(hall_on_true_poses(1, 0.0, 1));
  const Bounds bounds = single_bounds(input);
  ASSERT_EQ(bounds.tags.size(), 1U);
  BoundInput exact = input;
  const Eigen::MatrixXd expected = brute_force_covariance(exact);
  const Eigen::Matrix2d found = covariance_of(bounds, 0).topLeftCorner<2, 2>();
  EXPECT_LT((found - expected.topLeftCorner<2, 2>()).norm(), 1e-3 * found.norm());
}

void expect_the_marginal_covariance(const BoundInput& input) {
  const Eigen::MatrixXd expected = brute_force_covariance(input);
  const Bounds joint = joint_bounds(input);
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) {
      const Eigen::Matrix2d found = joint.covariance.block<2, 2>(3 * i, 3 * j);
      const Eigen::Matrix2d brute = expected.block<2, 2>(3 * i, 3 * j);
      // Linear interpolation between knots misses a little of the process.
      const double scale = Eigen::Matrix2d(expected.block<2, 2>(3 * i, 3 * i)).norm();
      EXPECT_LT((found - brute).norm(), 0.03 * scale);
    }
  }
}

TEST(Bound, WithPoseErrorIsThatOfTheMarginalCovariance) {
  expect_the_marginal_covariance(input_of(hall_on_true_poses(3, 0.01, 2)));
}

TEST(Bound, WithPausesIsThatOfTheMarginalCovariance) {
  made::Hall hall = hall_on_true_poses(3, 0.01, 2);
  for (const double pause_s : {7.0, 30.0, 86400.0}) {
    made::Hall paused = hall;
    made::pause(paused, 6.0, pause_s);
    expect_the_marginal_covariance(input_of(paused));
  }
}

TEST(Bound, OfOneTagAloneIsNoBetterThanOfAllTogether) {
  const BoundInput input = input_of(hall_on_true_poses(4, 0.02, 3));
  const Bounds joint = joint_bounds(input);
  const Bounds single = single_bounds(input);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT(covariance_of(joint, i).trace(), covariance_of(single, i).trace());
  }
}

TEST(Bound, GrowsWithTheNoiseAndFallsWithAKnownOffset) {
  const made::Hall hall = hall_on_true_poses(1, 0.0, 4);
  const Eigen::Matrix3d one = covariance_of(single_bounds(input_of(hall, 0.1)), 0);
  const Eigen::Matrix3d five = covariance_of(single_bounds(input_of(hall, 0.5)), 0);
  EXPECT_LT((five - 25.0 * one).norm(), 1e-3 * five.norm());
  BoundInput known = input_of(hall, 0.1);
  known.truth.offset_known.insert("a");
  EXPECT_LT(covariance_of(single_bounds(known), 0).trace(), one.trace());
}

TEST(Bound, OfReferenceTagsIsZero) {
  BoundInput input = input_of(hall_on_true_poses(2, 0.02, 5));
  const double alone = covariance_of(joint_bounds(input), 1).trace();
  input.truth.reference_tags["t0"] = input.places["t0"];
  const Bounds bounds = joint_bounds(input);
  EXPECT_EQ(covariance_of(bounds, 0).norm(), 0.0);
  EXPECT_LT(covariance_of(bounds, 1).trace(), alone);
}

TEST(Bound, MeanErrorIsThatOfTheNormalDistribution) {
  // On a line the mean of |x| is σ√(2/π). For a circle it is σ√(π/2), the mean of Rayleigh's
  // distribution.
  const Eigen::Matrix3d line = Eigen::Vector3d(4.0, 0.0, 9.0).asDiagonal();
  EXPECT_NEAR(mean_horizontal_error(line), 2.0 * std::sqrt(2.0 / kPi), 1e-12);
  const Eigen::Matrix3d circle = Eigen::Vector3d(4.0, 4.0, 0.0).asDiagonal();
  EXPECT_NEAR(mean_horizontal_error(circle), 2.0 * std::sqrt(kPi / 2.0), 1e-12);
  made::Rng rng(1);
  double sum = 0.0;
  constexpr int kDraws = 200000;
  for (int i = 0; i < kDraws; ++i) {
    const Eigen::Vector2d drawn{made::normal(rng, 3.0), made::normal(rng, 1.0)};
    sum += drawn.norm();
  }
  const Eigen::Matrix3d ellipse = Eigen::Vector3d(9.0, 1.0, 0.0).asDiagonal();
  EXPECT_NEAR(mean_horizontal_error(ellipse), sum / kDraws, 0.02);  // Five standard deviations.
}

}  // namespace
}  // namespace tagfield
