// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/pose_knots.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "tagfield/localization/joint/joint_system.h"
#include "tagfield/localization/test/problem_of.h"

namespace tagfield {
namespace {

using Index = Eigen::Index;

constexpr double kTau = 3.0;
constexpr double kDay = 86400.0;

/// One antenna that moves along x and reads one tag at these times.
LocalizationProblem read_at(const std::vector<double>& times_s) {
  LocalizationProblem problem;
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    const Eigen::Vector3d p_WA(0.1 * static_cast<double>(i), 0.0, 0.4);
    const Time stamp = time_from_seconds(times_s[i]);
    problem.tracks["a"].X_WA.push_back({stamp, from_translation(p_WA)});
    problem.samples["t"]["a"].push_back({stamp, 0.0, 865.7e6, p_WA, -60.0});
  }
  problem.pose_error = PoseErrorModel{0.02, 0.0, kTau};
  return problem;
}

PoseKnots knots_of(const LocalizationProblem& problem, double spacing_s) {
  return make_knots(problem, &*problem.pose_error, spacing_s);
}

std::vector<double> times_of(const PoseKnots& knots) {
  std::vector<double> times;
  for (const PoseKnots::Piece& piece : knots.chains.at(0).pieces) {
    for (Index k = 0; k < piece.count; ++k) {
      times.push_back(piece.begin_s + static_cast<double>(k) * piece.spacing_s);
    }
  }
  return times;
}

/// Correlations e^(−|t − t'|/τ) between two sets of times.
Eigen::MatrixXd covariance_between(const std::vector<double>& a, const std::vector<double>& b) {
  Eigen::MatrixXd K(static_cast<Index>(a.size()), static_cast<Index>(b.size()));
  for (Index i = 0; i < K.rows(); ++i) {
    for (Index j = 0; j < K.cols(); ++j) {
      const double apart = a[static_cast<std::size_t>(i)] - b[static_cast<std::size_t>(j)];
      K(i, j) = std::exp(-std::abs(apart) / kTau);
    }
  }
  return K;
}

/// Reads for two seconds, a pause of two time constants, reads, a pause of a day, reads.
std::vector<double> with_pauses() {
  std::vector<double> times;
  for (const double begin : {0.0, 2.0 + 2.0 * kTau, kDay}) {
    for (int i = 0; i <= 10; ++i) times.push_back(begin + 0.2 * i);
  }
  return times;
}

JointSystem without_tags(const PoseKnots& knots, unsigned seed) {
  JointSystem system;
  system.knots = knots;
  system.u = Eigen::VectorXd::Zero(knots.count() * knots.size);
  made::Rng rng(seed);
  for (double& value : system.u) value = made::normal(rng, 1.0);
  return system;
}

Eigen::VectorXd of_axis(const Eigen::VectorXd& u, int axis) {
  return Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<2>>(u.data() + axis, u.size() / 2);
}

TEST(PoseKnots, AreEvenOverReadsWithoutPauses) {
  std::vector<double> times;
  times.reserve(21);
  for (int i = 0; i <= 20; ++i) times.push_back(100.0 + 0.5 * i);
  const PoseKnots knots = knots_of(read_at(times), 0.25);
  ASSERT_EQ(knots.chains.size(), 1U);
  ASSERT_EQ(knots.chains[0].pieces.size(), 1U);
  EXPECT_EQ(knots.count(), 41);
  EXPECT_EQ(times_of(knots).front(), 100.0);
  EXPECT_NEAR(times_of(knots).back(), 110.0, 1e-9);
}

TEST(PoseKnots, AreAsManyAfterAPauseOfAYearAsOfADay) {
  for (const double pause_s : {60.0, kDay, 365.0 * kDay, 4e9}) {
    std::vector<double> times;
    times.reserve(22);
    for (int i = 0; i <= 10; ++i) times.push_back(0.2 * i);
    for (int i = 0; i <= 10; ++i) times.push_back(pause_s + 0.2 * i);
    EXPECT_EQ(knots_of(read_at(times), 0.5).count(), 10) << pause_s;
  }
}

TEST(PoseKnots, OfReadsFarApartAreAtMostAsManyAsGoIntoATimeConstant) {
  for (const double apart_s : {0.9 * kTau, 1.1 * kTau, 100.0 * kTau}) {
    std::vector<double> times;
    times.reserve(50);
    for (int i = 0; i < 50; ++i) times.push_back(apart_s * i);
    EXPECT_LE(knots_of(read_at(times), kTau / 40.0).count(), 50 * 41) << apart_s;
  }
}

TEST(PoseKnots, PriorIsTheDenseNormalDistributionAcrossPauses) {
  const PoseKnots knots = knots_of(read_at(with_pauses()), 0.5);
  ASSERT_EQ(knots.chains.at(0).pieces.size(), 3U);
  JointSystem system = without_tags(knots, 1);
  const Eigen::MatrixXd K = covariance_between(times_of(knots), times_of(knots));
  const Eigen::LLT<Eigen::MatrixXd> factors(K);
  double expected = 0.0;
  for (const int axis : {0, 1}) {
    const Eigen::VectorXd u = of_axis(system.u, axis);
    expected += u.dot(factors.solve(u));
  }
  EXPECT_NEAR(cost_of(system), expected, 1e-8 * expected);
  // ln |K⁻¹| of two axes, which evidence() subtracts again.
  const double log_determinant =
      -4.0 * Eigen::MatrixXd(factors.matrixL()).diagonal().array().log().sum();
  EXPECT_NEAR(covariance_of(system, 1).log_determinant, log_determinant, 1e-8);
  EXPECT_NEAR(evidence(system, 0.0, log_determinant), 0.0, 1e-8);
}

TEST(PoseKnots, WithoutDataTheMinimumIsZero) {
  JointSystem system = without_tags(knots_of(read_at(with_pauses()), 0.5), 2);
  EXPECT_LT(minimize(system, 20, 1), 1e-12);
  EXPECT_LT(system.u.norm(), 1e-6);
}

TEST(PoseKnots, InAPauseTheErrorIsTheMeanGivenTheKnots) {
  const PoseKnots knots = knots_of(read_at(with_pauses()), 0.5);
  const JointSystem system = without_tags(knots, 3);
  const std::vector<double> times = times_of(knots);
  const Eigen::MatrixXd K = covariance_between(times, times);
  const double later = 2.0 + 2.0 * kTau;
  for (const double time_s :
       {2.001, 3.0, 5.0, later - 0.001, later + 2.1, later + 20.0, 0.5 * kDay, kDay - 0.5}) {
    const Eigen::RowVectorXd weights =
        K.ldlt().solve(covariance_between(times, {time_s})).transpose();
    const Eigen::Vector3d error = error_at(knots, system.u, knots.chains[0], time_s);
    for (const int axis : {0, 1}) {
      EXPECT_NEAR(error[axis], 0.02 * weights.dot(of_axis(system.u, axis)), 1e-9) << time_s;
    }
    EXPECT_TRUE(error.allFinite());
  }
}

}  // namespace
}  // namespace tagfield
