// SPDX-License-Identifier: Apache-2.0
#include "tagfield/fit/envelope_matrix.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <random>

namespace tagfield {
namespace {

using Index = Eigen::Index;

struct Made {
  std::vector<Index> firsts;
  Eigen::MatrixXd dense;
};

/// A diagonally dominant matrix with random entries in an envelope.
Made made_of(Index size, unsigned seed) {
  std::mt19937_64 rng(seed);
  std::uniform_real_distribution<double> entry(-1.0, 1.0);
  Made made;
  made.dense = Eigen::MatrixXd::Zero(size, size);
  for (Index i = 0; i < size; ++i) {
    const auto far = std::uniform_int_distribution<Index>(0, i)(rng);
    made.firsts.push_back(rng() % 4 == 0 ? far : std::max<Index>(0, i - 3));
    for (Index j = made.firsts.back(); j < i; ++j) {
      made.dense(i, j) = made.dense(j, i) = entry(rng);
    }
    made.dense(i, i) = static_cast<double>(size);
  }
  return made;
}

EnvelopeMatrix envelope_of(const Made& made) {
  EnvelopeMatrix matrix(made.firsts);
  for (Index i = 0; i < made.dense.rows(); ++i) {
    for (Index j = made.firsts[static_cast<std::size_t>(i)]; j < i; ++j) {
      Eigen::Matrix2d pair = Eigen::Matrix2d::Zero();
      pair(1, 0) = made.dense(i, j);
      matrix.add({j, i}, pair);
    }
    matrix.add({i}, made.dense.block(i, i, 1, 1));
  }
  return matrix;
}

RC_GTEST_PROP(EnvelopeMatrix, SolvesAndInvertsAsDenseMatricesDo, ()) {
  const auto size = *rc::gen::inRange<Index>(1, 300);
  const Made made = made_of(size, *rc::gen::arbitrary<unsigned>());
  EnvelopeMatrix matrix = envelope_of(made);
  RC_ASSERT(matrix.factorize(2));
  const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(size, -1.0, 2.0);
  RC_ASSERT((made.dense * matrix.solve(right) - right).norm() < 1e-12 * right.norm());
  const Eigen::MatrixXd L = made.dense.llt().matrixL();
  const double log_determinant = 2.0 * L.diagonal().array().log().sum();
  RC_ASSERT(std::abs(matrix.log_determinant() - log_determinant) < 1e-12 * (1.0 + log_determinant));
  matrix.invert(2);
  const Eigen::MatrixXd inverse = made.dense.inverse();
  for (Index i = 0; i < size; ++i) {
    for (Index j = made.firsts[static_cast<std::size_t>(i)]; j <= i; ++j) {
      const Eigen::MatrixXd found =
          matrix.block(i == j ? std::vector<Index>{i} : std::vector<Index>{j, i});
      RC_ASSERT(std::abs(found(found.rows() - 1, 0) - inverse(i, j)) < 1e-13);
      RC_ASSERT(found == Eigen::MatrixXd(found.transpose()));
    }
  }
}

TEST(EnvelopeMatrix, ThreadsAndInstructionSetsGiveTheSameBits) {
  const Made made = made_of(400, 7);
  EnvelopeMatrix plain = envelope_of(made);
  ASSERT_TRUE(plain.factorize(1, InstructionSet::kBaseline));
  EnvelopeMatrix plain_inverse = plain;
  plain_inverse.invert(1, InstructionSet::kBaseline);
  const Eigen::VectorXd right = Eigen::VectorXd::Ones(400);
  for (const InstructionSet set : instruction_sets()) {
    EnvelopeMatrix other = envelope_of(made);
    ASSERT_TRUE(other.factorize(3, set));
    EXPECT_TRUE(other.solve(right) == plain.solve(right));
    other.invert(3, set);
    for (Index i = 0; i < 400; ++i) {
      EXPECT_EQ(other.block({i})(0, 0), plain_inverse.block({i})(0, 0));
    }
  }
}

TEST(EnvelopeMatrix, SaysWhereThereAreNoFactors) {
  EnvelopeMatrix matrix({0, 0});
  Eigen::Matrix2d indefinite;
  indefinite << 1.0, 2.0, 2.0, 1.0;
  matrix.add({0, 1}, indefinite);
  EXPECT_FALSE(matrix.factorize(1));
}

TEST(EnvelopeMatrix, WorkOfADenseMatrixIsASixthOfItsCube) {
  const std::vector<Index> firsts(300, 0);
  EXPECT_NEAR(work_of_factors(firsts), 300.0 * 300.0 * 300.0 / 6.0, 0.01 * 4.5e6);
}

}  // namespace
}  // namespace tagfield
