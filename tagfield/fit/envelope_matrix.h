// SPDX-License-Identifier: Apache-2.0
/// @file
/// Cholesky factors and inverses of large symmetric positive definite matrices in envelope
/// (skyline) storage: each row is 0 up to its first entry, and factors have the same envelope
/// (George and Liu, "Computer Solution of Large Sparse Positive Definite Systems", 1981).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "tagfield/base/lanes.h"

namespace tagfield {

/// Lower triangle in square tiles, stored by rows of tiles, each from its first nonzero tile to the
/// one on the diagonal.
class EnvelopeMatrix {
 public:
  static constexpr Eigen::Index kTile = 48;
  using Tile = Eigen::Matrix<double, kTile, kTile>;

  /// A zero matrix. Row i can have entries in the columns [firsts[i], i] only; 0 ≤ firsts[i] ≤ i.
  explicit EnvelopeMatrix(const std::vector<Eigen::Index>& firsts);

  [[nodiscard]] Eigen::Index size() const { return size_; }

  /// Adds the lower triangle of the square `block` to `rows` and the same columns. `rows` must be
  /// ascending, and the first of them no less than firsts[] of the others.
  void add(const std::vector<Eigen::Index>& rows, const Eigen::MatrixXd& block);

  /// Replaces the matrix A by its Cholesky factor L, A = L Lᵀ; false if A is not positive definite.
  /// Bit-identical for any number of threads and any instruction set.
  [[nodiscard]] bool factorize(int threads, InstructionSet set = instruction_sets().back());

  /// Of the factor L: ln |A|.
  [[nodiscard]] double log_determinant() const;

  /// Of the factor L: A⁻¹ right.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

  /// Replaces the factor L by the entries of A⁻¹ in the envelope, by Takahashi's recursion, which
  /// needs no other entries.
  void invert(int threads, InstructionSet set = instruction_sets().back());

  /// The symmetric block of these rows and columns, which must be ascending and in the envelope as
  /// for add().
  [[nodiscard]] Eigen::MatrixXd block(const std::vector<Eigen::Index>& rows) const;

 private:
  [[nodiscard]] double* tile(Eigen::Index row, Eigen::Index column);
  [[nodiscard]] const double* tile(Eigen::Index row, Eigen::Index column) const;
  [[nodiscard]] std::vector<Eigen::Index> below(Eigen::Index column) const;

  Eigen::Index size_ = 0;
  std::vector<Eigen::Index> first_tiles_;  ///< First tile of each row of tiles.
  std::vector<std::size_t> starts_;        ///< Start of each row of tiles in values_, in tiles.
  std::vector<double> values_;             ///< Tiles, each in column-major order.
};

/// Approximate number of multiply-adds of factorize().
double work_of_factors(const std::vector<Eigen::Index>& firsts);

}  // namespace tagfield
