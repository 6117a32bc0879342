// SPDX-License-Identifier: Apache-2.0
#include "tagfield/fit/symmetric.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <type_traits>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

using Eigen::Dynamic;

/// Up to 6 by 6 on the stack, used for all fixed sizes: Eigen unrolls each fixed size, which takes
/// four times as long to compile and saves little.
using Small = Eigen::Matrix<double, Dynamic, Dynamic, Eigen::ColMajor, 6, 6>;
using SmallVector = Eigen::Matrix<double, Dynamic, 1, Eigen::ColMajor, 6, 1>;

template <int N>
using Work = std::conditional_t<N == Dynamic, Eigen::MatrixXd, Small>;

template <int N>
using WorkVector = std::conditional_t<N == Dynamic, Eigen::VectorXd, SmallVector>;

template <typename Matrix, typename Right>
Right solved(const Matrix& A, const Right& B) {
  return A.ldlt().solve(B);
}

template <typename Matrix>
double log_determinant_of(const Matrix& A) {
  return A.ldlt().vectorD().array().log().sum();
}

template <typename Matrix>
std::optional<Matrix> cholesky_factor_of(const Matrix& A) {
  const Eigen::LLT<Matrix> factors(A);
  // Eigen does not report NaN in A.
  if (factors.info() != Eigen::Success || !factors.matrixLLT().allFinite()) return std::nullopt;
  return Matrix(factors.matrixL());
}

SymmetricEigen<Dynamic> eigen_of(const Eigen::MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace

template <int N>
Eigen::Matrix<double, N, 1> solve_symmetric(const Eigen::Matrix<double, N, N>& A,
                                            const Eigen::Matrix<double, N, 1>& b) {
  return solved<Work<N>, WorkVector<N>>(A, b);
}

Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return solved(A, B);
}

template <int N>
Eigen::Matrix<double, N, N> invert_symmetric(const Eigen::Matrix<double, N, N>& A) {
  return solved<Work<N>, Work<N>>(A, Work<N>::Identity(A.rows(), A.cols()));
}

template <int N>
double log_determinant(const Eigen::Matrix<double, N, N>& A) {
  return log_determinant_of<Work<N>>(A);
}

template <int N>
std::optional<Eigen::Matrix<double, N, N>> cholesky_factor(const Eigen::Matrix<double, N, N>& A) {
  const std::optional<Work<N>> L = cholesky_factor_of<Work<N>>(A);
  if (!L) return std::nullopt;
  return Eigen::Matrix<double, N, N>(*L);
}

Eigen::MatrixXd root_of_symmetric(const Eigen::MatrixXd& A) {
  const Eigen::LDLT<Eigen::MatrixXd> factors(A);
  const Eigen::VectorXd scale = factors.vectorD().cwiseMax(0.0).cwiseSqrt();
  const Eigen::MatrixXd lower = factors.matrixL();
  return factors.transpositionsP().transpose() * (lower * scale.asDiagonal()).eval();
}

template <int N>
SymmetricEigen<N> symmetric_eigen(const Eigen::Matrix<double, N, N>& A) {
  const SymmetricEigen<Dynamic> eigen = eigen_of(A);
  return {eigen.values, eigen.vectors};
}

double log_normal_density(Eigen::VectorXd& x, Eigen::MatrixXd& covariance) {
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> root(covariance);
  const double log_det = 2.0 * covariance.diagonal().array().log().sum();
  root.matrixL().solveInPlace(x);
  return -0.5 * (x.squaredNorm() + log_det + static_cast<double>(x.size()) * std::log(kTwoPi));
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
template Eigen::MatrixXd invert_symmetric(const Eigen::MatrixXd&);
template double log_determinant(const Eigen::Matrix4d&);
template double log_determinant(const Eigen::Matrix<double, 6, 6>&);
template std::optional<Eigen::Matrix3d> cholesky_factor(const Eigen::Matrix3d&);
template std::optional<Eigen::Matrix<double, 6, 6>> cholesky_factor(
    const Eigen::Matrix<double, 6, 6>&);
template SymmetricEigen<3> symmetric_eigen(const Eigen::Matrix3d&);
template SymmetricEigen<6> symmetric_eigen(const Eigen::Matrix<double, 6, 6>&);

}  // namespace tagfield
