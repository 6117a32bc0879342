// SPDX-License-Identifier: Apache-2.0
#include "tagfield/fit/products.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace tagfield {
namespace {

/// A matrix of integers, whose sums are exact.
Eigen::MatrixXd any_matrix(Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXd matrix(rows, columns);
  for (Eigen::Index i = 0; i < matrix.size(); ++i) matrix(i) = *rc::gen::inRange(-9, 10);
  return matrix;
}

/// Product by its definition, element by element.
Eigen::MatrixXd multiplied(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(A.rows(), B.cols());
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    for (Eigen::Index j = 0; j < B.cols(); ++j) {
      for (Eigen::Index k = 0; k < A.cols(); ++k) all(i, j) += A(i, k) * B(k, j);
    }
  }
  return all;
}

// Sizes up to 40: Eigen multiplies small and large matrices by different algorithms.
RC_GTEST_PROP(Products, AreSumsOfProducts, ()) {
  const int rows = *rc::gen::inRange(1, 40);
  const int inner = *rc::gen::inRange(1, 40);
  const Eigen::MatrixXd A = any_matrix(rows, inner);
  const Eigen::MatrixXd B = any_matrix(inner, *rc::gen::inRange(1, 40));
  RC_ASSERT(product(A, B) == multiplied(A, B));
  const Eigen::MatrixXd square = any_matrix(inner, inner);
  RC_ASSERT(transformed(A, square) == multiplied(multiplied(A, square), A.transpose()));
  const Eigen::VectorXd w = any_matrix(inner, 1);
  const Eigen::MatrixXd diagonal = w.asDiagonal();
  RC_ASSERT(weighted_scatter(A, w) == multiplied(multiplied(A, diagonal), A.transpose()));
}

RC_GTEST_PROP(Products, TakePartsOfMatrices, ()) {
  const Eigen::MatrixXd all = any_matrix(9, 9);
  RC_ASSERT(product(all.topLeftCorner(4, 5), all.transpose().middleRows(2, 5)) ==
            multiplied(all.topLeftCorner(4, 5), all.transpose().middleRows(2, 5)));
}

}  // namespace
}  // namespace tagfield
