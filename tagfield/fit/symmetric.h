// SPDX-License-Identifier: Apache-2.0
/// @file
/// Equations, factors and eigenvectors of symmetric matrices, by Eigen's LDLᵀ with pivots, LLᵀ and
/// QR. All are compiled once, in symmetric.cc: each takes seconds, in every source that asks Eigen
/// for it. N is a fixed size up to 6, or Eigen::Dynamic.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace tagfield {

/// x of A x = b. A is positive or negative semidefinite; of what it says nothing
/// of, x is 0.
template <int N>
Eigen::Matrix<double, N, 1> solve_symmetric(const Eigen::Matrix<double, N, N>& A,
                                            const Eigen::Matrix<double, N, 1>& b);

/// X of A X = B, for any number of right sides.
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// A⁻¹ of such a matrix.
template <int N>
Eigen::Matrix<double, N, N> invert_symmetric(const Eigen::Matrix<double, N, N>& A);

/// ln |A|, not a number where A is not positive.
template <int N>
double log_determinant(const Eigen::Matrix<double, N, N>& A);

/// L, lower triangular, of A = L Lᵀ; nothing where A is not positive definite.
template <int N>
std::optional<Eigen::Matrix<double, N, N>> cholesky_factor(const Eigen::Matrix<double, N, N>& A);

/// R of A = R Rᵀ where A is positive semidefinite; of what is negative by rounding, 0.
Eigen::MatrixXd root_of_symmetric(const Eigen::MatrixXd& A);

template <int N>
struct SymmetricEigen {
  Eigen::Matrix<double, N, 1> values;   ///< Rising.
  Eigen::Matrix<double, N, N> vectors;  ///< Column by column, of unit length.
};

template <int N>
SymmetricEigen<N> symmetric_eigen(const Eigen::Matrix<double, N, N>& A);

/// ln of the density of a normal distribution of mean 0 at `x`. Overwrites both.
double log_normal_density(Eigen::VectorXd& x, Eigen::MatrixXd& covariance);

}  // namespace tagfield
