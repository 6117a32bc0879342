// SPDX-License-Identifier: Apache-2.0
#include "tagfield/fit/symmetric.h"

#include <Eigen/Cholesky>

namespace tagfield {

template <int N>
Eigen::Matrix<double, N, 1> solve_symmetric(const Eigen::Matrix<double, N, N>& A,
                                            const Eigen::Matrix<double, N, 1>& b) {
  return A.ldlt().solve(b);
}

template <int N>
Eigen::Matrix<double, N, N> invert_symmetric(const Eigen::Matrix<double, N, N>& A) {
  return A.ldlt().solve(Eigen::Matrix<double, N, N>(Eigen::Matrix<double, N, N>::Identity()));
}

template <int N>
double log_determinant(const Eigen::Matrix<double, N, N>& A) {
  return A.ldlt().vectorD().array().log().sum();
}

template Eigen::Vector2d solve_symmetric(const Eigen::Matrix2d&, const Eigen::Vector2d&);
template Eigen::Vector3d solve_symmetric(const Eigen::Matrix3d&, const Eigen::Vector3d&);
template Eigen::Vector4d solve_symmetric(const Eigen::Matrix4d&, const Eigen::Vector4d&);
template Eigen::Matrix<double, 5, 1> solve_symmetric(const Eigen::Matrix<double, 5, 5>&,
                                                     const Eigen::Matrix<double, 5, 1>&);
template Eigen::Matrix<double, 6, 1> solve_symmetric(const Eigen::Matrix<double, 6, 6>&,
                                                     const Eigen::Matrix<double, 6, 1>&);
template Eigen::Matrix3d invert_symmetric(const Eigen::Matrix3d&);
template Eigen::Matrix4d invert_symmetric(const Eigen::Matrix4d&);
template Eigen::Matrix<double, 5, 5> invert_symmetric(const Eigen::Matrix<double, 5, 5>&);
template Eigen::Matrix<double, 6, 6> invert_symmetric(const Eigen::Matrix<double, 6, 6>&);
template double log_determinant(const Eigen::Matrix4d&);
template double log_determinant(const Eigen::Matrix<double, 6, 6>&);

}  // namespace tagfield
