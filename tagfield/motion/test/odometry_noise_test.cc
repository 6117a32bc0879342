// SPDX-License-Identifier: Apache-2.0
#include "tagfield/motion/odometry_noise.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "tagfield/base/test/error_text.h"
#include "tagfield/base/test/statistics.h"
#include "tagfield/base/units.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

constexpr int kRobots = 20'000;

/// Estimated poses of robots after `steps` equal increments, each with independent noise.
std::vector<PlanarPose> believed(const PlanarPose& increment, int steps, const OdometryNoise& noise,
                                 std::uint64_t seed) {
  std::vector<PlanarPose> ends;
  for (std::uint64_t robot = 0; robot < kRobots; ++robot) {
    RandomStream stream(seed, Purpose::kWheelOdometry, robot);
    PlanarPose pose;
    for (int i = 0; i < steps; ++i) pose = compose(pose, noisy_increment(increment, noise, stream));
    ends.push_back(pose);
  }
  return ends;
}

Eigen::Matrix3d sample_covariance(const std::vector<PlanarPose>& poses) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const PlanarPose& pose : poses) {
    const Eigen::Vector3d q(pose.x, pose.y, pose.yaw);
    sum += q;
    squares += q * q.transpose();
  }
  const auto n = static_cast<double>(poses.size());
  return (squares - sum * sum.transpose() / n) / (n - 1.0);
}

/// Expects each entry of two covariances, one or both of them sampled, to differ by less than 6
/// standard deviations of a sampled entry, √((cᵢᵢcⱼⱼ + cᵢⱼ²)/n): a false alarm rate of 1e-8.
void expect_same(const Eigen::Matrix3d& sample, const Eigen::Matrix3d& expected, double samples) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      const double spread =
          std::sqrt((expected(i, i) * expected(j, j) + expected(i, j) * expected(i, j)) / kRobots);
      EXPECT_NEAR(sample(i, j), expected(i, j), 6.0 * std::sqrt(samples) * spread + 1e-12)
          << i << j;
    }
  }
}

TEST(OdometryNoise, DefaultsSuitAP3At) {
  const auto sigma = [](const PlanarPose& increment) {
    return Eigen::Vector3d(increment_covariance(increment, {}).diagonal().cwiseSqrt());
  };
  const Eigen::Vector3d driven = sigma({1.0, 0.0, 0.0});
  EXPECT_NEAR(driven.x(), 0.01, 0.001);
  EXPECT_NEAR(driven.z(), radians(0.5), radians(0.05));
  EXPECT_NEAR(sigma({0.0, 0.0, kTwoPi}).z(), radians(3.0), radians(0.3));
}

TEST(OdometryNoise, AMetreAtOnceIsAsAHundredCentimetres) {
  const OdometryNoise noise{0.03, 0.02, 0.02, 0.01};
  const auto whole = sample_covariance(believed({1.0, 0.0, 0.0}, 1, noise, 1));
  const auto cut = sample_covariance(believed({0.01, 0.0, 0.0}, 100, noise, 2));
  expect_same(whole, cut, 2.0);
  // And both equal the stated covariance, which has a closed form.
  const Eigen::Matrix3d stated = increment_covariance({1.0, 0.0, 0.0}, noise);
  expect_same(whole, stated, 1.0);
  expect_same(cut, stated, 1.0);
  EXPECT_NEAR(stated(0, 0), 4e-4, 1e-15);
  EXPECT_NEAR(stated(1, 1), 4e-4 / 3.0, 1e-15);
  EXPECT_NEAR(stated(2, 2), 4e-4, 1e-15);
  EXPECT_NEAR(stated(1, 2), 4e-4 / 2.0, 1e-15);
}

TEST(OdometryNoise, ATurnAtOnceIsAsAHundredSmallOnes) {
  // Only the heading: the direction of the position error when turning on the spot depends on the
  // headings.
  const OdometryNoise noise{0.03, 0.02, 0.02, 0.01};
  const auto whole = sample_covariance(believed({0.0, 0.0, 2.0}, 1, noise, 1));
  const auto cut = sample_covariance(believed({0.0, 0.0, 0.02}, 100, noise, 2));
  const double expected = 0.03 * 0.03 * 2.0;
  // 6 standard deviations, √(2/n) each, of the variance of 20,000 draws.
  EXPECT_NEAR(whole(2, 2), expected, 0.06 * expected);
  EXPECT_NEAR(cut(2, 2), expected, 0.06 * expected);
  const double way = 0.01 * 0.01 * 2.0;
  EXPECT_NEAR(whole(0, 0) + whole(1, 1), way, 0.085 * way);
  EXPECT_NEAR(cut(0, 0) + cut(1, 1), way, 0.085 * way);
}

TEST(OdometryNoise, AGentleArcIsNearlyAsItsPieces) {
  const OdometryNoise noise{0.02, 0.01, 0.01, 0.002};
  const BodyVelocity velocity{0.3, 0.2};
  const auto whole = sample_covariance(believed(advance({}, velocity, 2.0), 1, noise, 1));
  const auto cut = sample_covariance(believed(advance({}, velocity, 0.02), 100, noise, 2));
  // A chord is shorter than its arc and has a single direction.
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(std::sqrt(whole(i, i) / cut(i, i)), 1.0, 0.06) << i;
  }
}

RC_GTEST_PROP(OdometryNoise, CovarianceIsThatOfTheDraws, ()) {
  const auto any = [](double most) { return most * 1e-4 * *rc::gen::inRange(-10000, 10000); };
  const PlanarPose increment{any(0.5), any(0.2), any(1.0)};
  const OdometryNoise noise{std::abs(any(0.03)), std::abs(any(0.03)), std::abs(any(0.03)),
                            std::abs(any(0.03))};
  const Eigen::Matrix3d stated = increment_covariance(increment, noise);
  const Eigen::Matrix3d sample = sample_covariance(believed(increment, 1, noise, 3));
  for (int i = 0; i < 3; ++i) {
    // Second-order terms are products of two errors of at most 0.04.
    const double allowed = 0.06 * stated(i, i) + 1e-6;
    RC_ASSERT(std::abs(sample(i, i) - stated(i, i)) < allowed);
  }
  // Symmetric and positive semidefinite.
  RC_ASSERT((stated - stated.transpose()).norm() < 1e-15);
  RC_ASSERT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(stated).eigenvalues().minCoeff() >
            -1e-12);
}

TEST(OdometryNoise, DrawsAreGaussianAboutTheTruth) {
  const OdometryNoise noise;
  const auto ends = believed({1.0, 0.0, 0.0}, 1, noise, 5);
  std::vector<double> ways;
  std::vector<double> headings;
  for (const PlanarPose& end : ends) {
    ways.push_back((std::hypot(end.x, end.y) - 1.0) / noise.alpha3);
    headings.push_back(end.yaw / noise.alpha2);
  }
  EXPECT_LT(statistics::kolmogorov(ways, statistics::normal_cdf), statistics::kKolmogorovBound);
  EXPECT_LT(statistics::kolmogorov(headings, statistics::normal_cdf), statistics::kKolmogorovBound);
}

TEST(OdometryNoise, BackwardsIsAsForwards) {
  const OdometryNoise noise;
  const Eigen::Matrix3d forwards = increment_covariance({0.5, 0.0, 0.0}, noise);
  const Eigen::Matrix3d backwards = increment_covariance({-0.5, 0.0, 0.0}, noise);
  EXPECT_LT((forwards.diagonal() - backwards.diagonal()).norm(), 1e-15);
  EXPECT_NEAR(backwards(1, 2), -forwards(1, 2), 1e-15);
}

TEST(OdometryNoise, AHairAsideChangesNothing) {
  // The odometry of a robot that turns on the spot contains a tiny translation in an arbitrary
  // direction.
  const OdometryNoise noise;
  const Eigen::Matrix3d exact = increment_covariance({0.0, 0.0, 0.1}, noise);
  for (const auto& [x, y] : {std::pair{1e-9, 0.0}, {-1e-9, 0.0}, {0.0, 1e-9}, {0.0, -1e-9}}) {
    const Eigen::Matrix3d off = increment_covariance({x, y, 0.1}, noise);
    EXPECT_LT((off - exact).norm(), 1e-6 * exact.norm());
    RandomStream one(1, Purpose::kWheelOdometry);
    RandomStream two(1, Purpose::kWheelOdometry);
    const PlanarPose a = noisy_increment({x, y, 0.1}, noise, one);
    const PlanarPose b = noisy_increment({0.0, 0.0, 0.1}, noise, two);
    EXPECT_NEAR(a.x, b.x, 1e-8);
    EXPECT_NEAR(a.y, b.y, 1e-8);
    EXPECT_NEAR(a.yaw, b.yaw, 1e-6);
  }
}

TEST(OdometryNoise, StandingStillIsKnownExactly) {
  RandomStream stream(1, Purpose::kWheelOdometry);
  const PlanarPose still = noisy_increment({}, {}, stream);
  EXPECT_EQ(still.x, 0.0);
  EXPECT_EQ(still.y, 0.0);
  EXPECT_EQ(still.yaw, 0.0);
  EXPECT_EQ(increment_covariance({}, {}), Eigen::Matrix3d::Zero());
}

TEST(OdometryNoise, WithoutNoiseIsTheTruth) {
  RandomStream stream(1, Purpose::kWheelOdometry);
  const PlanarPose same = noisy_increment({0.3, -0.1, 0.7}, {0.0, 0.0, 0.0, 0.0}, stream);
  EXPECT_DOUBLE_EQ(same.x, 0.3);
  EXPECT_DOUBLE_EQ(same.y, -0.1);
  EXPECT_DOUBLE_EQ(same.yaw, 0.7);
}

TEST(OdometryNoise, RefusesBadParameters) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_of([] { check(OdometryNoise{}); }), "(no error)");
  EXPECT_EQ(error_of([] {
              check(OdometryNoise{-0.1, 0.0, 0.0, 0.0});
            }),
            "alpha1 must be a finite number, 0 or more, is -0.1");
  EXPECT_TRUE(contains(error_of([nan] { check(OdometryNoise{0.0, nan, 0.0, 0.0}); }), "alpha2"));
  EXPECT_TRUE(contains(error_of([] { check(OdometryNoise{0.0, 0.0, -1.0, 0.0}); }), "alpha3"));
  EXPECT_TRUE(contains(error_of([] { check(OdometryNoise{0.0, 0.0, 0.0, -1.0}); }), "alpha4"));
}

}  // namespace
}  // namespace tagfield
