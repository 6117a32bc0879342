// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/scan/two_paths.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

using Steering = Eigen::MatrixXcf;  ///< Rows: field of a position along the scan, of norm 1.

constexpr double kNearestWall = 0.1;       ///< Minimum distance of a tag from the scan [m].
constexpr double kAlongStep = 1.0 / 13.0;  ///< [λ]
constexpr double kAwayFactor = 1.035;
constexpr double kOtherAlongStep = 1.0 / 3.0;  ///< Of the second path's positions [λ].
constexpr double kOtherAwayFactor = 1.12;
constexpr double kMinPathLeft = 1e-6;  ///< Of the power; the limit of float precision.
constexpr Eigen::Index kRowsAtOnce = 64;

Eigen::ArrayXd evenly(double low, double high, double step) {
  const auto count = static_cast<Eigen::Index>(std::ceil((high - low) / step)) + 1;
  return Eigen::ArrayXd::LinSpaced(count, low, high);
}

Eigen::ArrayXd by_factor(double low, double high, double factor) {
  const auto count = static_cast<Eigen::Index>(std::ceil(std::log(high / low) / std::log(factor)));
  return Eigen::ArrayXd::LinSpaced(count + 1, std::log(low), std::log(high)).exp();
}

/// A panel's field decreases with the cosine of the angle off boresight and with distance.
Steering steering(const ScanField& scan, const ScanGrid& grid) {
  const Eigen::Index n = scan.along_m.size();
  Steering rows(grid.along_m.size() * grid.away_m.size(), n);
  Eigen::Index at = 0;
  for (const double away : grid.away_m) {
    const double beside = std::hypot(away, scan.up_m);
    for (const double along : grid.along_m) {
      const Eigen::ArrayXd r = ((scan.along_m - along).square() + beside * beside).sqrt();
      const Eigen::ArrayXd amplitude = beside / r.square();
      const Eigen::ArrayXd phase = scan.wavenumber * r;
      const double norm = std::sqrt(amplitude.square().sum());
      for (Eigen::Index i = 0; i < n; ++i) {
        rows(at, i) = std::complex<float>(std::polar(amplitude[i] / norm, phase[i]));
      }
      ++at;
    }
  }
  return rows;
}

/// Area that each position represents, in order; the sum is 1.
Eigen::ArrayXf areas(const ScanGrid& grid) {
  Eigen::ArrayXf area(grid.along_m.size() * grid.away_m.size());
  Eigen::Index at = 0;
  for (const double away : grid.away_m) {
    for (Eigen::Index i = 0; i < grid.along_m.size(); ++i) area[at++] = static_cast<float>(away);
  }
  return area / area.sum();
}

/// Second positions, which all first ones are combined with.
struct Others {
  Steering rows;
  Eigen::ArrayXcf seen;  ///< Their match with the field.
  Eigen::ArrayXf area;
};

/// Likelihood of one position; `least`: smallest remaining power so far.
double likelihood_of(const Others& others, const Eigen::ArrayXcf& overlap, std::complex<float> seen,
                     double exponent, float& least) {
  // Two positions with nearly the same field are one path.
  constexpr float kDistinct = 0.01f;
  double sum = 0.0;
  for (Eigen::Index j = 0; j < overlap.size(); ++j) {
    const float apart = 1.0f - std::norm(overlap[j]);
    if (apart < kDistinct) continue;
    const std::complex<float> first = (seen - overlap[j] * others.seen[j]) / apart;
    const std::complex<float> second = (others.seen[j] - std::conj(overlap[j]) * seen) / apart;
    if (std::norm(second) > std::norm(first)) continue;
    const float explained = std::real(std::conj(seen) * first + std::conj(others.seen[j]) * second);
    const float left = std::max(1.0f - explained, static_cast<float>(kMinPathLeft));
    least = std::min(least, left);
    // Relative to the lower limit of the remaining power, to avoid overflow.
    sum += others.area[j] * std::exp(exponent * std::log(kMinPathLeft / static_cast<double>(left)));
  }
  return sum;
}

}  // namespace

ScanGrid scan_grid(const ScanField& scan, double furthest_m) {
  const double lambda = kTwoPi / scan.wavenumber;
  const double beyond = 0.5 * (scan.end_m - scan.begin_m);
  return {evenly(scan.begin_m - beyond, scan.end_m + beyond, kAlongStep * lambda),
          by_factor(kNearestWall, furthest_m, kAwayFactor)};
}

double one_path_share(const ScanField& scan, const ScanGrid& grid) {
  const Eigen::VectorXcf field = scan.field.matrix().cast<std::complex<float>>();
  return static_cast<double>((steering(scan, grid).conjugate() * field).cwiseAbs2().maxCoeff());
}

TwoPathLikelihood two_path_likelihood(const ScanField& scan, const ScanGrid& grid) {
  const double lambda = kTwoPi / scan.wavenumber;
  const double beyond = scan.end_m - scan.begin_m;
  const ScanGrid of_others = {
      evenly(scan.begin_m - beyond, scan.end_m + beyond, kOtherAlongStep * lambda),
      by_factor(kNearestWall, grid.away_m[grid.away_m.size() - 1], kOtherAwayFactor)};
  const Eigen::VectorXcf field = scan.field.matrix().cast<std::complex<float>>();
  Others others{steering(scan, of_others), {}, areas(of_others)};
  others.seen = (others.rows.conjugate() * field).array();
  const Steering rows = steering(scan, grid);
  const Eigen::VectorXcf seen = rows.conjugate() * field;
  const double exponent = std::max(scan.samples - 2.0, 1.0);
  Eigen::ArrayXd likelihood(rows.rows());
  float least = 1.0f;
  for (Eigen::Index begin = 0; begin < rows.rows(); begin += kRowsAtOnce) {
    const Eigen::Index count = std::min(kRowsAtOnce, rows.rows() - begin);
    const Eigen::MatrixXcf overlaps =
        others.rows * rows.middleRows(begin, count).adjoint();  // One column per position.
    for (Eigen::Index i = 0; i < count; ++i) {
      likelihood[begin + i] =
          likelihood_of(others, overlaps.col(i).array(), seen[begin + i], exponent, least);
    }
  }
  TwoPathLikelihood result;
  result.two_paths = 1.0 - static_cast<double>(least);
  result.relative =
      Eigen::Map<const Eigen::ArrayXXd>(likelihood.data(), grid.along_m.size(), grid.away_m.size());
  const double most = result.relative.maxCoeff();
  if (most > 0.0) result.relative /= most;
  return result;
}

}  // namespace tagfield
