// SPDX-License-Identifier: Apache-2.0
/// @file
/// A few equations with a symmetric matrix, by Eigen's LDLᵀ with pivots. Each size is compiled
/// once, in symmetric.cc: it takes seconds, in every source that asks Eigen for it.
#pragma once

#include <Eigen/Core>

namespace tagfield {

/// x of A x = b. A is positive or negative semidefinite; of what it says nothing
/// of, x is 0.
template <int N>
Eigen::Matrix<double, N, 1> solve_symmetric(const Eigen::Matrix<double, N, N>& A,
                                            const Eigen::Matrix<double, N, 1>& b);

/// A⁻¹ of such a matrix.
template <int N>
Eigen::Matrix<double, N, N> invert_symmetric(const Eigen::Matrix<double, N, N>& A);

/// ln |A|, not a number where A is not positive.
template <int N>
double log_determinant(const Eigen::Matrix<double, N, N>& A);

}  // namespace tagfield
