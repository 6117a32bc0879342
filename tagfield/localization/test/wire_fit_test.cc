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
      const Eigen::Matrix2d expected =
          with_prior.fullPivLu().inverse().topLeftCorner<2, 2>() -
          information.topLeftCorner<3, 3>().eval().fullPivLu().inverse().topLeftCorner<2, 2>();
      const Eigen::Matrix2d added = added_by_wire(all);
      EXPECT_LT((added - expected).norm(), 1e-9 * (1.0 + expected.norm())) << turning;
      // Not to know something never makes a position more certain.
      EXPECT_GE(added(0, 0), -1e-12);
      EXPECT_GE(added.determinant(), -1e-15);
    }
  }
}

TEST(WireFit, OtherFitsAddTheirDistanceByTheirLikelihood) {
  std::mt19937 random(6);
  WireFits all;
  all.noise_m2 = 1e-4;
  all.fits.resize(2);
  for (WirePoint& fit : all.fits) fit.normal = 1e-4 * random_normal(1.0, random);
  const Eigen::Matrix2d alone = added_by_wire({{all.fits[0]}, all.noise_m2});
  all.fits[1].place.head<2>() = Eigen::Vector2d(0.03, -0.04);
  all.fits[0].cost = 2e-3;
  for (const double more : {0.0, 2e-4, 1.0}) {
    all.fits[1].cost = all.fits[0].cost + more;
    const double weight = std::exp(-0.5 * more / all.noise_m2);
    const Eigen::Vector2d apart(0.03, -0.04);
    const Eigen::Matrix2d expected = weight / (1.0 + weight) * apart * apart.transpose();
    EXPECT_LT((added_by_wire(all) - alone - expected).norm(), 1e-12) << more;
  }
}

}  // namespace
}  // namespace tagfield
