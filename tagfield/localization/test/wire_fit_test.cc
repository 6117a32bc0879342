// SPDX-License-Identifier: Apache-2.0
// What a wire of unknown direction adds to a position's covariance.
#include "tagfield/localization/wire_fit.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

namespace tagfield {
namespace {

using Matrix5d = Eigen::Matrix<double, 5, 5>;

/// Normal equations of twelve reads with random gradients. The wire's direction has about `turning`
/// of the information that its prior of a radian has, the position 1e4 [1/m²].
Matrix5d random_normal(double turning, std::mt19937& random) {
  std::normal_distribution<double> unit;
  Eigen::Matrix<double, 12, 5> gradients;
  for (Eigen::Index i = 0; i < gradients.size(); ++i) gradients.data()[i] = unit(random);
  gradients.leftCols<3>() *= 100.0 / std::sqrt(12.0);
  gradients.rightCols<2>() *= std::sqrt(turning / 12.0);
  return gradients.transpose() * gradients;
}

constexpr HeightModel kFree{HeightModel::Kind::kFree, 0.0, 1.0};

TEST(WireFit, AnUnknownDirectionAddsWhatItsPriorLeaves) {
  std::mt19937 random(5);
  constexpr double kNoise_m2 = 0.25;
  for (const double turning : {1e-6, 0.3, 1.0, 30.0}) {
    for (int i = 0; i < 20; ++i) {
      const Matrix5d information = random_normal(turning, random);
      WireFits all;
      all.noise_m2 = kNoise_m2;
      all.fits.emplace_back();
      all.fits[0].normal = kNoise_m2 * information;
      Matrix5d with_prior = information;
      with_prior(3, 3) += 1.0;
      with_prior(4, 4) += 1.0;
      const Eigen::Matrix3d expected =
          with_prior.fullPivLu().inverse().topLeftCorner<3, 3>() -
          information.topLeftCorner<3, 3>().eval().fullPivLu().inverse();
      const Eigen::Matrix3d added = added_by_wire(kFree, all);
      EXPECT_LT((added - expected).norm(), 1e-9 * (1.0 + expected.norm())) << turning;
      // Not to know something never makes a position more certain.
      EXPECT_GE(added(0, 0), -1e-12);
      EXPECT_GE(added(2, 2), -1e-12);
      EXPECT_GE((added.topLeftCorner<2, 2>().determinant()), -1e-15);
    }
  }
}

TEST(WireFit, OtherFitsAddTheirDistanceByTheirLikelihood) {
  std::mt19937 random(6);
  WireFits all;
  all.noise_m2 = 1e-4;
  all.fits.resize(2);
  for (WirePoint& fit : all.fits) fit.normal = 1e-4 * random_normal(1.0, random);
  const Eigen::Matrix3d alone = added_by_wire(kFree, {{all.fits[0]}, all.noise_m2});
  const Eigen::Vector3d apart(0.03, -0.04, 0.06);
  all.fits[1].place = apart;
  all.fits[0].cost = 2e-3;
  for (const double more : {0.0, 2e-4, 1.0}) {
    all.fits[1].cost = all.fits[0].cost + more;
    const double weight = std::exp(-0.5 * more / all.noise_m2);
    const Eigen::Matrix3d expected = weight / (1.0 + weight) * apart * apart.transpose();
    EXPECT_LT((added_by_wire(kFree, all) - alone - expected).norm(), 1e-12) << more;
  }
}

/// From a level path only q = (z − z_a)² is estimated: dz = dq / 2|z − z_a|.
TEST(WireFit, HeightsGrowByTheSquareOfWhatIsEstimated) {
  std::mt19937 random(7);
  const HeightModel level{HeightModel::Kind::kLevel, 1.0, 1.0};
  const HeightModel known{HeightModel::Kind::kKnown, 1.0, 1.0};
  WireFits all;
  all.noise_m2 = 1e-4;
  all.fits.resize(1);
  all.fits[0].normal = 1e-4 * random_normal(1.0, random);
  all.fits[0].place = {3.0, 2.0, 0.36};
  const Eigen::Matrix3d by_q = added_by_wire(kFree, all);
  const Eigen::Matrix3d by_height = added_by_wire(level, all);
  EXPECT_NEAR(by_height(2, 2), by_q(2, 2) / (4.0 * 0.36), 1e-12);
  EXPECT_NEAR(by_height(0, 2), by_q(0, 2) / (2.0 * 0.6), 1e-12);
  EXPECT_EQ(added_by_wire(known, all).row(2).norm(), 0.0);
  all.fits.push_back(all.fits[0]);
  all.fits[1].place.z() = 0.49;
  EXPECT_NEAR(added_by_wire(level, all)(2, 2) - by_height(2, 2), 0.5 * 0.1 * 0.1, 1e-12);
}

}  // namespace
}  // namespace tagfield
