// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/mutual_impedance.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

using Complex = std::complex<double>;
using Eigen::Vector3d;

constexpr double kLambda = 0.35;
constexpr double kWave = kTwoPi / kLambda;

/// In wavelengths, with wires that are thin compared to them.
Complex thin(double across, double along) {
  constexpr double kLong = 100.0;
  return parallel_impedance(kTwoPi / kLong, across * kLong, along * kLong);
}

void expect_near(Complex actual, Complex expected, double tolerance, const std::string& what) {
  EXPECT_NEAR(actual.real(), expected.real(), tolerance) << what;
  EXPECT_NEAR(actual.imag(), expected.imag(), tolerance) << what;
}

/// Vertical field of a vertical Hertzian dipole of 1 A m, near and far.
Complex hertzian(double across, double along) {
  const double r = std::hypot(across, along);
  const Complex jkr(0.0, kWave * r);
  constexpr double kImpedance = 376.730313668;
  const Complex radial = kImpedance / (kTwoPi * r * r) * (1.0 + 1.0 / jkr) * std::exp(-jkr);
  const Complex polar = kImpedance * Complex(0.0, kWave) / (4.0 * kPi * r) *
                        (1.0 + 1.0 / jkr + 1.0 / (jkr * jkr)) * std::exp(-jkr);
  const double cosine = along / r;
  return radial * cosine * cosine - polar * (1.0 - cosine * cosine);
}

/// −∫∫ E_z of one wire's segments times the other's current, both with half-wave cosine currents.
Complex summed_up(double across, double along) {
  constexpr int kPieces = 600;
  constexpr double kStep = 0.5 * kLambda / kPieces;
  Complex sum = 0.0;
  for (int i = 0; i < kPieces; ++i) {
    const double from = (i + 0.5) * kStep - 0.25 * kLambda;
    for (int j = 0; j < kPieces; ++j) {
      const double to = (j + 0.5) * kStep - 0.25 * kLambda;
      sum -= std::cos(kWave * from) * std::cos(kWave * to) * hertzian(across, along + to - from);
    }
  }
  return sum * kStep * kStep;
}

TEST(ExponentialIntegral, HasTheTabulatedSineAndCosineIntegrals) {
  // Abramowitz and Stegun, tables 5.1 and 5.2; x, Si, Ci.
  const double table[][3] = {{0.1, 0.0999444611, -1.7278683866},
                             {1.0, 0.9460830704, 0.3374039229},
                             {kPi, 1.8519370520, 0.0736679120},
                             {5.0, 1.5499312449, -0.1900297497},
                             {10.0, 1.6583475942, -0.0454564330}};
  for (const auto& [x, si, ci] : table) {
    const Complex e = exponential_integral(x);
    EXPECT_NEAR(-e.real(), ci, 1e-9) << x;
    EXPECT_NEAR(e.imag() + 0.5 * kPi, si, 1e-9) << x;
  }
}

TEST(ParallelImpedance, IsThePublishedOneSideBySideAndInLine) {
  // Kraus, Antennas; Balanis, Antenna Theory: side by side at 0, λ/2 and λ, and collinear end to
  // end. They use 120π Ω for free space's 376.73.
  constexpr double kFree = 376.730313668 / (120.0 * kPi);
  expect_near(thin(0.0, 0.0), Complex(73.13, 42.54) * kFree, 0.01, "one place");
  expect_near(thin(0.0, 0.0), kDipoleImpedance_ohm, 0.005, "one place");
  expect_near(thin(0.5, 0.0), {-12.52, -29.91}, 0.02, "half a wavelength");
  expect_near(thin(1.0, 0.0), {4.01, 17.73}, 0.02, "a wavelength");
  expect_near(thin(0.0, 0.5), {26.4, 20.2}, 0.1, "end to end");
}

TEST(ParallelImpedance, IsTheSumOverBothWiresPieces) {
  for (const auto& [across, along] :
       {std::pair(0.1, 0.0), {0.3, 0.1}, {0.05, 0.4}, {0.7, 0.35}, {1.5, 0.9}, {0.1, 1.2}}) {
    const Complex closed = parallel_impedance(kWave, across * kLambda, along * kLambda);
    expect_near(closed, summed_up(across * kLambda, along * kLambda), 0.02,
                std::to_string(across) + " " + std::to_string(along));
  }
}

TEST(MutualImpedance, IsThatOfParallelWiresAndNothingAcross) {
  const Vector3d up = Vector3d::UnitZ();
  const Vector3d between(0.1, 0.05, 0.07);
  const Complex parallel = parallel_impedance(kWave, std::hypot(0.1, 0.05), 0.07);
  expect_near(mutual_impedance(kWave, up, up, between), parallel, 1e-12, "parallel");
  expect_near(mutual_impedance(kWave, up, -up, between), -parallel, 1e-12, "the other way round");
  expect_near(mutual_impedance(kWave, up, Vector3d::UnitX(), between), 0.0, 1e-12, "across");
}

Vector3d any_direction() {
  const double z = 1e-4 * *rc::gen::inRange(-10000, 10000);
  const double around = 1e-3 * *rc::gen::inRange(0, 6283);
  const double radius = std::sqrt(1.0 - z * z);
  return {radius * std::cos(around), radius * std::sin(around), z};
}

RC_GTEST_PROP(MutualImpedance, IsTheSameFromBothSides, ()) {
  const Vector3d a = any_direction();
  const Vector3d b = any_direction();
  const Vector3d between = 1e-3 * *rc::gen::inRange(1, 1000) * any_direction();
  const Complex there = mutual_impedance(kWave, a, b, between);
  const Complex back = mutual_impedance(kWave, b, a, -between);
  RC_ASSERT(std::abs(there - back) < 1e-9);
  RC_ASSERT(std::isfinite(there.real()) && std::isfinite(there.imag()));
}

TEST(CoupledShares, AreOnesOwnAlone) {
  const Eigen::RowVectorXcd shares = coupled_shares(Eigen::MatrixXcd::Zero(3, 3));
  expect_near(shares(0), 1.0, 1e-12, "own");
  expect_near(shares(1), 0.0, 1e-12, "another's");
}

TEST(CoupledShares, OfTwoAreThoseOfTheTwoPort) {
  // (2R I₁ + Z I₂ = V₁, Z I₁ + 2R I₂ = V₂): 2R I₁ = (V₁ − z V₂)/(1 − z²) with z = Z/2R.
  Eigen::MatrixXcd mutual = Eigen::MatrixXcd::Zero(2, 2);
  mutual(0, 1) = mutual(1, 0) = Complex(40.0, -25.0);
  const Complex z = Complex(40.0, -25.0) / (2.0 * kDipoleImpedance_ohm.real());
  const Eigen::RowVectorXcd shares = coupled_shares(mutual);
  expect_near(shares(0), 1.0 / (1.0 - z * z), 1e-12, "own");
  expect_near(shares(1), -z / (1.0 - z * z), 1e-12, "the other's");
}

TEST(CoupledShares, FadeWithDistance) {
  double last = 1.0;
  for (const double distance : {1.0, 4.0, 16.0, 64.0}) {
    Eigen::MatrixXcd mutual = Eigen::MatrixXcd::Zero(2, 2);
    mutual(0, 1) = mutual(1, 0) = parallel_impedance(kWave, distance * kLambda, 0.0);
    const double other = std::abs(coupled_shares(mutual)(1));
    EXPECT_LT(other, last / 2.0);
    last = other;
  }
  EXPECT_LT(last, 0.003);
}

}  // namespace
}  // namespace tagfield
