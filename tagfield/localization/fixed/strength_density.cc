// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/fixed/strength_density.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "tagfield/base/units.h"
#include "tagfield/fit/products.h"

namespace tagfield {
namespace {

constexpr double kLost = 12.0;             ///< Cells this far below the best [ln] are dropped.
constexpr double kSmallest = 1e-3;         ///< [m]
constexpr std::size_t kMostCells = 20000;  ///< With more cells, none is split further.

/// Quarters of the cells of these numbers.
PossiblePlaces split(const PossiblePlaces& places, const std::vector<Eigen::Index>& numbers) {
  const Eigen::Index count = 4 * static_cast<Eigen::Index>(numbers.size());
  PossiblePlaces quarters{{}, Eigen::ArrayXd(count), Eigen::ArrayXXd(count, places.density.cols())};
  quarters.cells.reserve(static_cast<std::size_t>(count));
  for (const Eigen::Index number : numbers) {
    const double size = places.size_m[number];
    for (Eigen::Index part = 0; part < 4; ++part) {
      const auto row = static_cast<Eigen::Index>(quarters.cells.size());
      const Eigen::Vector3d quarter(part % 2 == 0 ? -0.25 : 0.25, part < 2 ? -0.25 : 0.25, 0.0);
      quarters.cells.emplace_back(places.cells[static_cast<std::size_t>(number)] + size * quarter);
      quarters.size_m[row] = 0.5 * size;
      quarters.density.row(row) = places.density.row(number);
    }
  }
  return quarters;
}

}  // namespace

Eigen::MatrixXd levels_of(const TagOnGrid& tag, Eigen::Index columns) {
  const auto count = static_cast<Eigen::Index>(tag.antennas.size());
  Eigen::MatrixXd levels = Eigen::MatrixXd::Zero(count, columns);
  levels.col(0).setOnes();
  for (Eigen::Index i = 0; i < count; ++i) {
    levels(i, 1 + static_cast<Eigen::Index>(tag.antennas[static_cast<std::size_t>(i)])) = 1.0;
  }
  return levels;
}

namespace {

/// Misfits in all cells (columns), and their normal density.
struct Misfits {
  Eigen::MatrixXd whiten;   ///< W: W m has the identity as covariance, but for the slope's.
  Eigen::ArrayXd squares;   ///< mᵀ S⁻¹ m.
  Eigen::ArrayXd constant;  ///< ln |S| + n ln 2π.
};

/// Given the slope, the covariance B is the same in all cells; that of the slope adds u uᵀ, so that
/// S = B + u uᵀ has a closed inverse (Sherman and Morrison).
Misfits misfits(const TagOnGrid& tag, const StrengthLaw& law, const StrengthPrior& prior) {
  const Eigen::Index count = tag.rssi_dbm.size();
  const Eigen::Index slope = law.mean.size() - 1;
  const Eigen::MatrixXd levels = levels_of(tag, slope);
  const double variance = std::max(law.covariance(slope, slope), 1e-12);
  const Eigen::VectorXd with_slope = levels * law.covariance.col(slope).head(slope);
  Eigen::MatrixXd given_slope = transformed(levels, law.covariance.topLeftCorner(slope, slope)) -
                                with_slope * with_slope.transpose() / variance;
  given_slope.array() += prior.tag_sigma_db * prior.tag_sigma_db;
  given_slope.diagonal().array() += law.fading_db * law.fading_db;
  const Eigen::LLT<Eigen::MatrixXd> root(given_slope);
  Misfits of;
  of.whiten = root.matrixL().solve(Eigen::MatrixXd::Identity(count, count));
  const Eigen::VectorXd over_level = tag.rssi_dbm - levels * law.mean.head(slope);
  const Eigen::MatrixXd white =
      product(of.whiten, (law.mean[slope] * tag.log_distance - tag.gain_db).colwise() + over_level);
  const Eigen::MatrixXd u = product(of.whiten, (std::sqrt(variance) * tag.log_distance).colwise() -
                                                   with_slope / std::sqrt(variance));
  const Eigen::ArrayXd more = 1.0 + u.colwise().squaredNorm().transpose().array();
  const Eigen::ArrayXd along = white.cwiseProduct(u).colwise().sum().transpose().array();
  of.squares = white.colwise().squaredNorm().transpose().array() - along.square() / more;
  of.constant = more.log() - 2.0 * of.whiten.diagonal().array().log().sum() +
                static_cast<double>(count) * std::log(kTwoPi);
  return of;
}

/// Per antenna and cell: by how much the law's RSSI changes within the cell at most [dB].
Eigen::MatrixXd changes_of(const TagOnGrid& tag, const StrengthLaw& law) {
  return std::abs(law.mean[law.mean.size() - 1]) * tag.log_change + tag.gain_change_db;
}

}  // namespace

Eigen::ArrayXd log_strength(const TagOnGrid& tag, const StrengthLaw& law,
                            const StrengthPrior& prior) {
  const Misfits of = misfits(tag, law, prior);
  return -0.5 * (of.squares + of.constant);
}

CellStrengths cell_strengths(const TagOnGrid& tag, const StrengthLaw& law,
                             const StrengthPrior& prior) {
  const Misfits of = misfits(tag, law, prior);
  // √squares is a norm of the misfits, which changes by no more than the norm of their change.
  const Eigen::MatrixXd changes = product(of.whiten.cwiseAbs(), changes_of(tag, law));
  const Eigen::ArrayXd most = changes.colwise().norm().transpose().array();
  const Eigen::ArrayXd least = (of.squares.max(0.0).sqrt() - most).max(0.0).square();
  return {-0.5 * (of.squares + of.constant), -0.5 * (least + of.constant)};
}

TagOnGrid refined(const TagOnGrid& tag, const StrengthLaw& law, const StrengthPrior& prior) {
  TagOnGrid of = tag;
  std::vector<TagOnGrid> done;
  std::size_t count = 0;
  double best = -std::numeric_limits<double>::infinity();
  while (!of.places.cells.empty()) {
    const CellStrengths logs = cell_strengths(of, law, prior);
    const Eigen::MatrixXd changes = changes_of(of, law);
    best = std::max(best, logs.middle.maxCoeff());
    std::vector<Eigen::Index> fine;
    std::vector<Eigen::Index> coarse;
    const bool is_last = count + of.places.cells.size() > kMostCells;
    for (Eigen::Index i = 0; i < logs.bound.size(); ++i) {
      if (logs.bound[i] < best - kLost) continue;
      // Within ± x a value scatters by x/√3 at most, so half a fading adds at most 8 % of variance.
      const bool is_fine = changes.col(i).maxCoeff() < 0.5 * law.fading_db || is_last ||
                           of.places.size_m[i] < kSmallest;
      (is_fine ? fine : coarse).push_back(i);
    }
    count += fine.size();
    done.push_back(with_cells(of, fine));
    put_on(split(of.places, coarse), prior, of);
  }
  return joined(done);
}

}  // namespace tagfield
