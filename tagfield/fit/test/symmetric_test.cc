// SPDX-License-Identifier: Apache-2.0
#include "tagfield/fit/symmetric.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace tagfield {
namespace {

/// Aᵀ A + I with integers below `most` in A, hence positive definite.
template <int N>
Eigen::Matrix<double, N, N> any_positive(int most) {
  Eigen::Matrix<double, N, N> root;
  for (Eigen::Index i = 0; i < root.size(); ++i) root(i) = *rc::gen::inRange(1 - most, most);
  Eigen::Matrix<double, N, N> positive = root.transpose() * root;
  positive.diagonal().array() += 1.0;
  return positive;
}

template <int N>
void expect_solved() {
  const Eigen::Matrix<double, N, N> A = any_positive<N>(10);
  Eigen::Matrix<double, N, 1> x;
  for (Eigen::Index i = 0; i < N; ++i) x(i) = *rc::gen::inRange(-9, 10);
  // Rounding errors are multiplied by the condition number.
  RC_ASSERT((solve_symmetric(A, Eigen::Matrix<double, N, 1>(A * x)) - x).norm() < 1e-8);
  if constexpr (N > 2) {
    RC_ASSERT(
        (A * invert_symmetric(A) - Eigen::Matrix<double, N, N>::Identity()).cwiseAbs().maxCoeff() <
        1e-8);
  }
}

RC_GTEST_PROP(Symmetric, SolvesWhatWasMultiplied, ()) {
  expect_solved<2>();
  expect_solved<3>();
  expect_solved<4>();
  expect_solved<5>();
  expect_solved<6>();
}

/// Leibniz formula, over all permutations of the columns.
template <int N>
double determinant_by_orders(const Eigen::Matrix<double, N, N>& A) {
  Eigen::Matrix<Eigen::Index, N, 1> order;
  for (Eigen::Index i = 0; i < N; ++i) order(i) = i;
  double sum = 0.0;
  do {
    double term = 1.0;
    for (Eigen::Index i = 0; i < N; ++i) {
      for (Eigen::Index j = i + 1; j < N; ++j) {
        if (order(j) < order(i)) term = -term;
      }
      term *= A(i, order(i));
    }
    sum += term;
  } while (std::next_permutation(order.data(), order.data() + N));
  return sum;
}

// With small numbers, as the terms, up to 25⁶ each, cancel.
RC_GTEST_PROP(Symmetric, DeterminantIsLeibniz, ()) {
  const Eigen::Matrix4d four = any_positive<4>(3);
  RC_ASSERT(std::abs(log_determinant(four) - std::log(determinant_by_orders(four))) < 1e-4);
  const Eigen::Matrix<double, 6, 6> six = any_positive<6>(3);
  RC_ASSERT(std::abs(log_determinant(six) - std::log(determinant_by_orders(six))) < 1e-4);
}

TEST(Symmetric, WhatNothingIsSaidOfIsZero) {
  const Eigen::Matrix2d one = Eigen::Vector2d(4.0, 0.0).asDiagonal();
  const Eigen::Vector2d x = solve_symmetric(one, Eigen::Vector2d(2.0, 0.0));
  EXPECT_DOUBLE_EQ(x.x(), 0.5);
  EXPECT_EQ(x.y(), 0.0);
}

TEST(Symmetric, WhatIsNotPositiveHasNoLogarithm) {
  const Eigen::Matrix4d negative = Eigen::Vector4d(1.0, -2.0, 1.0, 1.0).asDiagonal();
  EXPECT_TRUE(std::isnan(log_determinant(negative)));
}

Eigen::MatrixXd any_positive_of_size(int size) {
  Eigen::MatrixXd root(size, size);
  for (Eigen::Index i = 0; i < root.size(); ++i) root(i) = *rc::gen::inRange(-9, 10);
  return root.transpose() * root + Eigen::MatrixXd::Identity(size, size);
}

RC_GTEST_PROP(Symmetric, OfAnySizeIsSolvedAndInverted, ()) {
  const int size = *rc::gen::inRange(1, 24);
  const Eigen::MatrixXd A = any_positive_of_size(size);
  Eigen::MatrixXd X(size, 3);
  for (Eigen::Index i = 0; i < X.size(); ++i) X(i) = *rc::gen::inRange(-9, 10);
  RC_ASSERT((solve_symmetric(A, Eigen::MatrixXd(A * X)) - X).cwiseAbs().maxCoeff() < 1e-5);
  RC_ASSERT((A * invert_symmetric(A) - Eigen::MatrixXd::Identity(size, size)).norm() < 1e-5);
}

template <int N>
void expect_factors() {
  const Eigen::Matrix<double, N, N> A = any_positive<N>(10);
  const auto L = cholesky_factor(A);
  RC_ASSERT(L.has_value());
  RC_ASSERT((*L * L->transpose() - A).norm() < 1e-12 * A.norm());
  for (Eigen::Index i = 0; i < N; ++i) {
    for (Eigen::Index j = i + 1; j < N; ++j) RC_ASSERT((*L)(i, j) == 0.0);
  }
  const SymmetricEigen<N> eigen = symmetric_eigen(A);
  for (Eigen::Index i = 0; i < N; ++i) {
    const auto column = eigen.vectors.col(i);
    RC_ASSERT((A * column - eigen.values(i) * column).norm() < 1e-10 * A.norm());
    RC_ASSERT(std::abs(column.norm() - 1.0) < 1e-12);
    RC_ASSERT(i == 0 || eigen.values(i) >= eigen.values(i - 1));
  }
}

RC_GTEST_PROP(Symmetric, FactorsAndAxesMakeItAgain, ()) {
  expect_factors<3>();
  expect_factors<6>();
}

TEST(Symmetric, WhatIsNotPositiveDefiniteHasNoFactor) {
  EXPECT_FALSE(cholesky_factor(Eigen::Matrix3d(Eigen::Vector3d(1, -1, 1).asDiagonal())));
  EXPECT_FALSE(cholesky_factor(Eigen::Matrix3d(Eigen::Vector3d(1, NAN, 1).asDiagonal())));
}

RC_GTEST_PROP(Symmetric, RootsOfWhatIsNotDefiniteToo, ()) {
  Eigen::MatrixXd thin(5, 2);
  for (Eigen::Index i = 0; i < thin.size(); ++i) thin(i) = *rc::gen::inRange(-9, 10);
  const Eigen::MatrixXd A = thin * thin.transpose();
  const Eigen::MatrixXd root = root_of_symmetric(A);
  RC_ASSERT((root * root.transpose() - A).norm() <= 1e-6 * (1.0 + A.norm()));
}

// For independent values it is the product of their densities.
TEST(Symmetric, NormalDensityIsThatOfItsAxes) {
  Eigen::VectorXd x = Eigen::Vector3d(0.3, -1.2, 2.0);
  const Eigen::Vector3d sigmas(0.5, 2.0, 1.0);
  double log = 0.0;
  for (Eigen::Index i = 0; i < 3; ++i) {
    log += std::log(std::exp(-0.5 * x(i) * x(i) / (sigmas(i) * sigmas(i))) /
                    (sigmas(i) * std::sqrt(2.0 * 3.14159265358979324)));
  }
  Eigen::Matrix3d turn;  // About z, by an angle with cosine 0.6: the density rotates with it.
  turn << 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1;
  Eigen::MatrixXd covariance =
      turn * Eigen::Matrix3d(sigmas.cwiseAbs2().asDiagonal()) * turn.transpose();
  x = turn * x;
  EXPECT_NEAR(log_normal_density(x, covariance), log, 1e-12);
}

}  // namespace
}  // namespace tagfield
