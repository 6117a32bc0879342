// SPDX-License-Identifier: Apache-2.0
/// @file
/// Linear equations, factors and eigenvectors of symmetric matrices, by Eigen's LDLᵀ with pivots,
/// LLᵀ and QR. All are compiled once, in symmetric.cc: each takes seconds to compile in every
/// source file that uses it. N is a fixed size up to 6, or Eigen::Dynamic.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace tagfield {

/// Solution x of A x = b. A is positive or negative semidefinite; components of x that it does not
/// determine are 0.
template <int N>
Eigen::Matrix<double, N, 1> solve_symmetric(const Eigen::Matrix<double, N, N>& A,
                                            const Eigen::Matrix<double, N, 1>& b);

/// Solution X of A X = B, for any number of right-hand sides.
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// Inverse A⁻¹ of such a matrix.
template <int N>
Eigen::Matrix<double, N, N> invert_symmetric(const Eigen::Matrix<double, N, N>& A);

/// ln |A|; NaN if A is not positive.
template <int N>
double log_determinant(const Eigen::Matrix<double, N, N>& A);

/// Lower triangular factor L of A = L Lᵀ; nullopt if A is not positive definite.
template <int N>
std::optional<Eigen::Matrix<double, N, N>> cholesky_factor(const Eigen::Matrix<double, N, N>& A);

/// Square root R of A = R Rᵀ, A positive semidefinite; pivots that are negative by rounding count
/// as 0.
Eigen::MatrixXd root_of_symmetric(const Eigen::MatrixXd& A);

template <int N>
struct SymmetricEigen {
  Eigen::Matrix<double, N, 1> values;   ///< Ascending.
  Eigen::Matrix<double, N, N> vectors;  ///< As columns of unit length.
};

template <int N>
SymmetricEigen<N> symmetric_eigen(const Eigen::Matrix<double, N, N>& A);

/// ln of the density of a normal distribution of mean 0 at `x`. Overwrites both arguments.
double log_normal_density(Eigen::VectorXd& x, Eigen::MatrixXd& covariance);

}  // namespace tagfield
