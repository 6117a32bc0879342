// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/internal/consistency.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "tagfield/base/random.h"

namespace tagfield {
namespace {

Eigen::VectorXd standard_normals(Eigen::Index count, RandomStream& stream) {
  Eigen::VectorXd draws(count);
  for (double& draw : draws) draw = standard_normal(stream);
  return draws;
}

Eigen::Matrix3d some_covariance() {
  Eigen::Matrix3d factor;
  factor << 0.02, 0, 0, 0.01, 0.03, 0, -0.02, 0.005, 0.05;
  return factor * factor.transpose();
}

MethodRun run_with(const std::vector<Nees>& values, double correlation) {
  MethodRun run;
  run.nees_correlation = correlation;
  for (const Nees& value : values) {
    TagRecord tag;
    tag.nees = value;
    run.tags.push_back(tag);
  }
  return run;
}

TEST(NeesOf, IsTheSquaredErrorInStandardDeviations) {
  const Eigen::Matrix3d covariance = Eigen::Vector3d(0.01, 0.04, 0.09).asDiagonal();
  const auto flat = nees_of({0.1, 0.4, 5.0}, covariance, false);
  ASSERT_TRUE(flat);
  EXPECT_NEAR(flat->value, 1.0 + 4.0, 1e-12);
  EXPECT_EQ(flat->dof, 2);
  const auto whole = nees_of({0.1, 0.4, 0.9}, covariance, true);
  ASSERT_TRUE(whole);
  EXPECT_NEAR(whole->value, 1.0 + 4.0 + 9.0, 1e-12);
  EXPECT_EQ(whole->dof, 3);
}

TEST(NeesOf, NeedsACovarianceThatIsOne) {
  EXPECT_FALSE(nees_of({0.1, 0.1, 0.0}, Eigen::Matrix3d::Zero(), false));
  Eigen::Matrix3d level = Eigen::Vector3d(0.01, 0.04, 0.0).asDiagonal();
  EXPECT_TRUE(nees_of({0.1, 0.1, 0.0}, level, false));
  EXPECT_FALSE(nees_of({0.1, 0.1, 0.0}, level, true));
  level(0, 0) = std::nan("");
  EXPECT_FALSE(nees_of({0.1, 0.1, 0.0}, level, false));
}

TEST(NeesBand, OfIndependentErrorsIsThatOfChiSquare) {
  // From a table: with 100 degrees of freedom 95 % lie between 74.222 and 129.561.
  const NeesBand band = nees_band(50, 100.0, 100.0);
  EXPECT_NEAR(band.low, 74.222 / 50.0, 1e-4);
  EXPECT_NEAR(band.high, 129.561 / 50.0, 1e-4);
}

TEST(NeesBand, OfErrorsThatAreAllTheSameIsThatOfOne) {
  // 5 tags with the same error count as one with 2 degrees of freedom: ‖·‖² is 2 for each pair.
  const NeesBand same = nees_band(5, 10.0, 5.0 * 5.0 * 2.0);
  const NeesBand one = nees_band(1, 2.0, 2.0);
  EXPECT_NEAR(same.low, one.low, 1e-12);
  EXPECT_NEAR(same.high, one.high, 1e-12);
}

/// Two tags whose errors share a component: the covariance's blocks are A and `share` A.
Bounds two_tags(double share) {
  Bounds bounds;
  bounds.tags = {"a", "b"};
  const Eigen::Matrix3d own = some_covariance();
  bounds.covariance.resize(6, 6);
  bounds.covariance << own, share * own, share * own, own;
  return bounds;
}

TEST(Correlation, AddsTheSquaresBetweenTags) {
  // Whitened, the block between the two is `share` times the identity.
  const Bounds bounds = two_tags(0.6);
  EXPECT_NEAR(correlation_of({{"a", 3}, {"b", 3}}, bounds), 6.0 + 2.0 * 3.0 * 0.36, 1e-9);
  EXPECT_NEAR(correlation_of({{"a", 2}, {"b", 2}}, bounds), 4.0 + 2.0 * 2.0 * 0.36, 1e-9);
  EXPECT_NEAR(correlation_of({{"a", 2}, {"c", 2}}, bounds), 4.0, 1e-12);
  EXPECT_NEAR(correlation_of({{"a", 2}, {"b", 2}}, {}), 4.0, 1e-12);
}

TEST(Correlation, GivesTheVarianceOfTheMean) {
  // Random samples: two tags with a shared error component, many runs with one mean each.
  const Bounds bounds = two_tags(0.8);
  const Eigen::MatrixXd root = bounds.covariance.llt().matrixL();
  const double correlation = correlation_of({{"a", 2}, {"b", 2}}, bounds);
  RandomStream stream(7, Purpose::kReadNoise);
  constexpr int kRuns = 40'000;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kRuns; ++i) {
    const Eigen::VectorXd error = root * standard_normals(6, stream);
    const double mean = 0.5 * (nees_of(error.head<3>(), some_covariance(), false)->value +
                               nees_of(error.tail<3>(), some_covariance(), false)->value);
    sum += mean;
    squares += mean * mean;
  }
  const double mean = sum / kRuns;
  EXPECT_NEAR(mean, 2.0, 0.05);
  EXPECT_NEAR(squares / kRuns - mean * mean, 2.0 * correlation / 4.0, 0.15);
}

/// Share of many samples, with errors `factor` times as large as stated, that are judged as
/// `expected`.
double share_found(double factor, Consistency expected) {
  constexpr int kSamples = 2000;
  constexpr int kTags = 20;
  const Eigen::Matrix3d covariance = some_covariance();
  const Eigen::Matrix3d root = covariance.llt().matrixL();
  RandomStream stream(11, Purpose::kReadNoise);
  int found = 0;
  for (int i = 0; i < kSamples; ++i) {
    std::vector<Nees> values;
    for (int tag = 0; tag < kTags; ++tag) {
      const Eigen::Vector3d error = factor * (root * standard_normals(3, stream));
      values.push_back(*nees_of(error, covariance, false));
    }
    const auto summary = nees_summary({run_with(values, 2.0 * kTags)});
    if (summary->consistency == expected) ++found;
  }
  return static_cast<double>(found) / kSamples;
}

TEST(NeesSummary, OfRightCovariancesIsConsistentIn95Of100Cases) {
  // Five standard deviations of a share of 0.95 in 2000 samples are 0.024.
  EXPECT_NEAR(share_found(1.0, Consistency::kConsistent), 0.95, 0.024);
}

TEST(NeesSummary, TellsTooBoldFromTooCautious) {
  EXPECT_GT(share_found(2.0, Consistency::kTooBold), 0.99);
  EXPECT_GT(share_found(0.5, Consistency::kTooCautious), 0.99);
}

TEST(NeesSummary, MixesTagsWithAndWithoutHeight) {
  const auto summary = nees_summary({run_with({{2.0, 2}, {4.0, 3}}, 5.0)});
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->count, 2U);
  EXPECT_NEAR(summary->mean, 3.0, 1e-12);
  EXPECT_NEAR(summary->expected, 2.5, 1e-12);
  const boost::math::chi_squared of_five(5.0);
  EXPECT_NEAR(summary->band.low, quantile(of_five, 0.025) / 2.0, 1e-9);
  EXPECT_FALSE(nees_summary({run_with({}, 0.0)}));
}

}  // namespace
}  // namespace tagfield
