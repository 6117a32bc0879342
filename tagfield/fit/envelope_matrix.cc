// SPDX-License-Identifier: Apache-2.0
#include "tagfield/fit/envelope_matrix.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "tagfield/base/parallel.h"

namespace tagfield {
namespace {

using Index = Eigen::Index;
using Tile = EnvelopeMatrix::Tile;
constexpr Index kTile = EnvelopeMatrix::kTile;
constexpr std::size_t kTileSize = static_cast<std::size_t>(kTile * kTile);

using MapOfTile = Eigen::Map<Tile>;
using ConstMapOfTile = Eigen::Map<const Tile>;

constexpr Index kRowsAtOnce = 8;
constexpr Index kColumnsAtOnce = 6;
static_assert(kTile % kRowsAtOnce == 0 && kTile % kColumnsAtOnce == 0);

/// c −= a bᵀ for one strip of rows and some columns, whose sums stay in registers.
inline void subtract_strip(const double* a, const double* b, double* c) {
  using Lanes = double __attribute__((vector_size(kRowsAtOnce * sizeof(double))));
  Lanes s0{}, s1{}, s2{}, s3{}, s4{}, s5{};
  for (Index k = 0; k < kTile; ++k) {
    Lanes x;
    std::memcpy(&x, a + k * kTile, sizeof x);
    const double* y = b + k * kTile;
    s0 += x * y[0];
    s1 += x * y[1];
    s2 += x * y[2];
    s3 += x * y[3];
    s4 += x * y[4];
    s5 += x * y[5];
  }
  const Lanes sums[kColumnsAtOnce] = {s0, s1, s2, s3, s4, s5};
  for (Index q = 0; q < kColumnsAtOnce; ++q) {
    Lanes old;
    std::memcpy(&old, c + q * kTile, sizeof old);
    old -= sums[q];
    std::memcpy(c + q * kTile, &old, sizeof old);
  }
}

/// c −= a bᵀ for whole tiles.
void subtract_product(const double* a, const double* b, double* c, InstructionSet set) {
  in_lanes(set, [&] {
    for (Index column = 0; column < kTile; column += kColumnsAtOnce) {
      for (Index row = 0; row < kTile; row += kRowsAtOnce) {
        subtract_strip(a + row, b + column, c + column * kTile + row);
      }
    }
  });
}

/// −a bᵀ.
Tile negative_product(const Tile& a, const Tile& b, InstructionSet set) {
  Tile product = Tile::Zero();
  subtract_product(a.data(), b.data(), product.data(), set);
  return product;
}

/// Consecutive rows of a block within one row of tiles.
struct Run {
  Index begin;  ///< First row in the block.
  Index count;
  Index tile;
  Index offset;  ///< Offset of the first row in the tile.
};

std::vector<Run> runs_of(const std::vector<Index>& rows) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Index row = rows[i];
    const bool goes_on = i > 0 && row == rows[i - 1] + 1 && row % kTile != 0;
    if (!goes_on) runs.push_back({static_cast<Index>(i), 0, row / kTile, row % kTile});
    ++runs.back().count;
  }
  return runs;
}

Tile inverse_of_lower(const Tile& lower) {
  Tile inverse = Tile::Identity();
  lower.triangularView<Eigen::Lower>().solveInPlace(inverse);
  return inverse;
}

}  // namespace

EnvelopeMatrix::EnvelopeMatrix(const std::vector<Index>& firsts)
    : size_(static_cast<Index>(firsts.size())), starts_{0} {
  const Index rows = (size_ + kTile - 1) / kTile;
  for (Index row = 0; row < rows; ++row) {
    const auto begin = firsts.begin() + row * kTile;
    const auto end = firsts.begin() + std::min(size_, (row + 1) * kTile);
    first_tiles_.push_back(*std::min_element(begin, end) / kTile);
    starts_.push_back(starts_.back() + static_cast<std::size_t>(row + 1 - first_tiles_.back()));
  }
  values_.assign(starts_.back() * kTileSize, 0.0);
  // A unit diagonal in the padding of the last tile keeps the factorization valid.
  for (Index i = size_; i < rows * kTile; ++i) {
    tile(rows - 1, rows - 1)[(i % kTile) * (kTile + 1)] = 1.0;
  }
}

double* EnvelopeMatrix::tile(Index row, Index column) {
  const auto at = static_cast<std::size_t>(row);
  return values_.data() +
         (starts_[at] + static_cast<std::size_t>(column - first_tiles_[at])) * kTileSize;
}

const double* EnvelopeMatrix::tile(Index row, Index column) const {
  const auto at = static_cast<std::size_t>(row);
  return values_.data() +
         (starts_[at] + static_cast<std::size_t>(column - first_tiles_[at])) * kTileSize;
}

/// Rows of tiles below the diagonal that have a tile in that column.
std::vector<Index> EnvelopeMatrix::below(Index column) const {
  std::vector<Index> rows;
  for (Index row = column + 1; row < static_cast<Index>(first_tiles_.size()); ++row) {
    if (first_tiles_[static_cast<std::size_t>(row)] <= column) rows.push_back(row);
  }
  return rows;
}

void EnvelopeMatrix::add(const std::vector<Index>& rows, const Eigen::MatrixXd& block) {
  const std::vector<Run> runs = runs_of(rows);
  for (std::size_t of_columns = 0; of_columns < runs.size(); ++of_columns) {
    const Run& columns = runs[of_columns];
    for (std::size_t of_rows = of_columns; of_rows < runs.size(); ++of_rows) {
      const Run& run = runs[of_rows];
      double* values = tile(run.tile, columns.tile);
      for (Index c = 0; c < columns.count; ++c) {
        const Index from = of_rows == of_columns ? c : 0;
        double* to = values + (columns.offset + c) * kTile + run.offset;
        const double* of_column = &block(run.begin, columns.begin + c);
        for (Index r = from; r < run.count; ++r) to[r] += of_column[r];
      }
    }
  }
}

bool EnvelopeMatrix::factorize(int threads, InstructionSet set) {
  for (Index j = 0; j < static_cast<Index>(first_tiles_.size()); ++j) {
    MapOfTile diagonal(tile(j, j));
    const Eigen::LLT<Tile> factors(diagonal);
    if (factors.info() != Eigen::Success) return false;
    diagonal = factors.matrixL();
    const Tile inverse = inverse_of_lower(diagonal);
    const std::vector<Index> rows = below(j);
    parallel_for(rows.size(), threads, [&](std::size_t i) {
      MapOfTile here(tile(rows[i], j));
      here = -negative_product(here, inverse, set);
    });
    parallel_for(rows.size(), threads, [&](std::size_t i) {
      for (std::size_t k = 0; k <= i; ++k) {
        subtract_product(tile(rows[i], j), tile(rows[k], j), tile(rows[i], rows[k]), set);
      }
    });
  }
  return true;
}

double EnvelopeMatrix::log_determinant() const {
  double sum = 0.0;
  for (Index j = 0; j < static_cast<Index>(first_tiles_.size()); ++j) {
    sum += 2.0 * ConstMapOfTile(tile(j, j)).diagonal().array().log().sum();
  }
  return sum;
}

Eigen::VectorXd EnvelopeMatrix::solve(const Eigen::VectorXd& right) const {
  const auto tiles = static_cast<Index>(first_tiles_.size());
  Eigen::VectorXd x = Eigen::VectorXd::Zero(tiles * kTile);
  x.head(size_) = right;
  for (Index i = 0; i < tiles; ++i) {
    auto here = x.segment<kTile>(i * kTile);
    for (Index j = first_tiles_[static_cast<std::size_t>(i)]; j < i; ++j) {
      here -= ConstMapOfTile(tile(i, j)) * x.segment<kTile>(j * kTile);
    }
    ConstMapOfTile(tile(i, i)).triangularView<Eigen::Lower>().solveInPlace(here);
  }
  for (Index i = tiles - 1; i >= 0; --i) {
    auto here = x.segment<kTile>(i * kTile);
    ConstMapOfTile(tile(i, i)).transpose().triangularView<Eigen::Upper>().solveInPlace(here);
    for (Index j = first_tiles_[static_cast<std::size_t>(i)]; j < i; ++j) {
      x.segment<kTile>(j * kTile) -= ConstMapOfTile(tile(i, j)).transpose() * here;
    }
  }
  return x.head(size_);
}

void EnvelopeMatrix::invert(int threads, InstructionSet set) {
  // With U = L_ij L_jj⁻¹ of the tiles under the diagonal, Z = A⁻¹ has Z_ij = −Σ_k Z_ik U_k and Z_jj
  // = L_jj⁻ᵀ L_jj⁻¹ − Σ_k U_kᵀ Z_kj, where k runs over the same rows, from the last column to the
  // first.
  for (auto j = static_cast<Index>(first_tiles_.size()) - 1; j >= 0; --j) {
    const Tile inverse = inverse_of_lower(ConstMapOfTile(tile(j, j)));
    const Tile turned = inverse.transpose();
    const std::vector<Index> rows = below(j);
    std::vector<Tile, Eigen::aligned_allocator<Tile>> U_turned(rows.size()), found(rows.size());
    parallel_for(rows.size(), threads, [&](std::size_t i) {
      U_turned[i] = -negative_product(ConstMapOfTile(tile(rows[i], j)), turned, set).transpose();
    });
    parallel_for(rows.size(), threads, [&](std::size_t i) {
      found[i].setZero();
      for (std::size_t k = 0; k < rows.size(); ++k) {
        const Tile Z = k <= i ? Tile(ConstMapOfTile(tile(rows[i], rows[k])))
                              : Tile(ConstMapOfTile(tile(rows[k], rows[i])).transpose());
        subtract_product(Z.data(), U_turned[k].data(), found[i].data(), set);
      }
    });
    Tile own = -negative_product(turned, turned, set);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const Tile Z_turned = found[k].transpose();
      subtract_product(U_turned[k].data(), Z_turned.data(), own.data(), set);
      MapOfTile(tile(rows[k], j)) = found[k];
    }
    MapOfTile(tile(j, j)) = 0.5 * (own + own.transpose());
  }
}

Eigen::MatrixXd EnvelopeMatrix::block(const std::vector<Index>& rows) const {
  const auto count = static_cast<Index>(rows.size());
  Eigen::MatrixXd block(count, count);
  for (Index c = 0; c < count; ++c) {
    const Index column = rows[static_cast<std::size_t>(c)];
    for (Index r = c; r < count; ++r) {
      const Index row = rows[static_cast<std::size_t>(r)];
      block(r, c) = tile(row / kTile, column / kTile)[(column % kTile) * kTile + row % kTile];
      block(c, r) = block(r, c);
    }
  }
  return block;
}

double work_of_factors(const std::vector<Index>& firsts) {
  double work = 0.0;
  for (std::size_t i = 0; i < firsts.size(); ++i) {
    const double width = static_cast<double>(static_cast<Index>(i) + 1 - firsts[i]);
    work += 0.5 * width * width;
  }
  return work;
}

}  // namespace tagfield
