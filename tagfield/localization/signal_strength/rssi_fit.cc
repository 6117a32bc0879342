// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/signal_strength/rssi_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "tagfield/localization/signal_strength/rssi_samples.h"

namespace tagfield {
namespace {

constexpr double kNearestAntenna = 0.05;  ///< Smaller distances are clamped to this [m].
constexpr Eigen::Index kHarmonics = 8;    ///< Of each end.
constexpr double kRootThree = 1.7320508075688772;

Eigen::Matrix3d rotation_of(const LocalizationProblem& problem, const std::string& antenna,
                            Time stamp) {
  const auto track = problem.tracks.find(antenna);
  if (track == problem.tracks.end() || track->second.X_WA.empty())
    return Eigen::Matrix3d::Identity();
  return held_pose_at(track->second.X_WA, stamp).rotation.toRotationMatrix();
}

using Harmonics = Eigen::Matrix<double, kHarmonics, 1>;

/// Spherical harmonics of the first and second degree of a unit vector; each degree is scaled so
/// that the sum of its squares is the same in all directions.
Harmonics harmonics_of(const Eigen::Vector3d& u) {
  Harmonics h;
  h << u.x(), u.y(), u.z(), u.x() * u.x() - u.y() * u.y(), 2.0 * u.x() * u.y(), 2.0 * u.x() * u.z(),
      2.0 * u.y() * u.z(), kRootThree * (u.z() * u.z() - 1.0 / 3.0);
  return h;
}

/// Gradient of c · harmonics_of(u).
Eigen::Vector3d gradient_of(const Eigen::Ref<const Harmonics>& c, const Eigen::Vector3d& u) {
  return {c[0] + 2.0 * (c[3] * u.x() + c[4] * u.y() + c[5] * u.z()),
          c[1] + 2.0 * (c[4] * u.x() - c[3] * u.y() + c[6] * u.z()),
          c[2] + 2.0 * (c[5] * u.x() + c[6] * u.y() + kRootThree * c[7] * u.z())};
}

/// Direction from the antenna to a position, and their distance [m].
struct Ray {
  Eigen::Vector3d u_W;
  double length = 0.0;
};

Ray ray_to(const BinnedRssi& bins, Eigen::Index i, const Eigen::Vector3d& p_WT) {
  const Eigen::Vector3d p_AT_W = p_WT - Eigen::Vector3d(bins.x[i], bins.y[i], bins.z[i]);
  const double length = std::max(p_AT_W.norm(), kNearestAntenna);
  return {p_AT_W / length, length};
}

/// Columns for a span, times the root of the weights: the level, and harmonics of the direction as
/// each end sees it.
Eigen::MatrixXd columns_at(const BinnedRssi& bins, const TagPhases::Span& span, bool with_gains,
                           const Eigen::Vector3d& p_WT) {
  const Eigen::ArrayXd root = bins.weight.segment(span.begin, span.count).sqrt();
  if (!with_gains) return root;
  Eigen::Matrix<double, 1 + 2 * kHarmonics, Eigen::Dynamic> rows(1 + 2 * kHarmonics, span.count);
  for (Eigen::Index k = 0; k < span.count; ++k) {
    const Eigen::Index i = span.begin + k;
    const Eigen::Vector3d u_W = ray_to(bins, i, p_WT).u_W;
    const Eigen::Vector3d u_A = bins.rotations_WA[static_cast<std::size_t>(i)].transpose() * u_W;
    rows(0, k) = root[k];
    rows.col(k).segment<kHarmonics>(1) = root[k] * harmonics_of(u_W);
    rows.col(k).tail<kHarmonics>() = root[k] * harmonics_of(u_A);
  }
  return rows.transpose();
}

RssiLevel level_of(const PathLossLaw& law, const std::string& antenna) {
  const auto level = law.levels.find(antenna);
  return level == law.levels.end() ? RssiLevel{} : level->second;
}

/// Levels and gains of a span as unknowns of a linear problem with a prior.
struct SpanSolver {
  Eigen::MatrixXd weighted;  ///< Columns times the root of the weights.
  Eigen::VectorXd precision;
  Eigen::LLT<Eigen::MatrixXd> normal;

  /// The most probable unknowns for values times the root of their weights.
  [[nodiscard]] Eigen::VectorXd solved(const Eigen::VectorXd& values, double level_dbm) const {
    Eigen::VectorXd right = weighted.transpose() * values;
    right[0] += precision[0] * level_dbm;
    return normal.solve(right);
  }
};

SpanSolver solver_of(const BinnedRssi& bins, const PathLossLaw& law, const TagPhases::Span& span,
                     const Eigen::Vector3d& p_WT) {
  const bool with_gains = law.pattern_sigma_db > 0.0;
  SpanSolver solver;
  solver.weighted = columns_at(bins, span, with_gains, p_WT);
  solver.precision.setConstant(
      solver.weighted.cols(),
      with_gains ? bins.noise_db2 / (law.pattern_sigma_db * law.pattern_sigma_db) : 0.0);
  solver.precision[0] = level_of(law, span.antenna).precision;
  Eigen::MatrixXd normal = solver.weighted.transpose() * solver.weighted;
  normal.diagonal() += solver.precision;
  solver.normal.compute(normal);
  return solver;
}

double log_determinant_of(const SpanSolver& solver) {
  const Eigen::VectorXd diagonal = solver.normal.matrixLLT().diagonal();
  double log = 2.0 * diagonal.array().log().sum();
  for (Eigen::Index k = 1; k < solver.precision.size(); ++k) log -= std::log(solver.precision[k]);
  return log;
}

/// Derivatives of the fitted gains for x and y [dB/m].
Eigen::MatrixX2d gain_slopes(const BinnedRssi& bins, const RssiMisfit& fit,
                             const Eigen::Vector3d& p_WT) {
  Eigen::MatrixX2d slopes = Eigen::MatrixX2d::Zero(bins.rssi.size(), 2);
  if (fit.coefficients.rows() == 0) return slopes;
  for (std::size_t k = 0; k < bins.spans.size(); ++k) {
    const auto c = fit.coefficients.col(static_cast<Eigen::Index>(k));
    const TagPhases::Span& span = bins.spans[k];
    for (Eigen::Index i = span.begin; i < span.begin + span.count; ++i) {
      const Ray ray = ray_to(bins, i, p_WT);
      const Eigen::Matrix3d& R_WA = bins.rotations_WA[static_cast<std::size_t>(i)];
      const Eigen::Vector3d gradient =
          gradient_of(c.head<kHarmonics>(), ray.u_W) +
          R_WA * gradient_of(c.tail<kHarmonics>(), R_WA.transpose() * ray.u_W);
      const Eigen::Vector3d across = gradient - ray.u_W.dot(gradient) * ray.u_W;
      slopes.row(i) = across.head<2>().transpose() / ray.length;
    }
  }
  return slopes;
}

/// Derivatives of the lobes' gains along an axis [dB/m].
Eigen::ArrayXd lobe_slopes(const BinnedRssi& bins, const Eigen::Vector3d& p_WT,
                           const Eigen::Vector3d& axis) {
  constexpr double kStep = 1e-4;  // [m]
  return (lobe_gains(bins, p_WT + kStep * axis) - lobe_gains(bins, p_WT - kStep * axis)) /
         (2.0 * kStep);
}

}  // namespace

BinnedRssi binned_rssi(const LocalizationProblem& problem, const SamplesOfTag& samples,
                       double bin_m, const Lobe& lobe) {
  BinnedRssi bins;
  bins.lobe = lobe;
  std::vector<RssiBin> all;
  for (const auto& [antenna, series] : rssi_along_paths(samples, bin_m)) {
    for (const RssiBin& bin : series) {
      bins.rotations_WA.push_back(rotation_of(problem, antenna, bin.stamp));
    }
    bins.spans.push_back(
        {static_cast<Eigen::Index>(all.size()), static_cast<Eigen::Index>(series.size()), antenna});
    all.insert(all.end(), series.begin(), series.end());
  }
  const auto count = static_cast<Eigen::Index>(all.size());
  for (Eigen::ArrayXd* column : {&bins.x, &bins.y, &bins.z, &bins.rssi, &bins.weight}) {
    column->resize(count);
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    const RssiBin& bin = all[static_cast<std::size_t>(i)];
    bins.x[i] = bin.p_WA.x();
    bins.y[i] = bin.p_WA.y();
    bins.z[i] = bin.p_WA.z();
    bins.rssi[i] = bin.rssi_dbm;
    // With more than a few reads, the error of a bin is dominated by the surroundings.
    bins.weight[i] = std::min(bin.reads, 4.0) / 4.0;
  }
  const double noise = noise_of_one(bins.spans, bins.weight.sqrt() * bins.rssi);
  bins.noise_db2 = std::max(noise * noise, kMinRssiNoise * kMinRssiNoise);
  return bins;
}

Eigen::ArrayXd distances(const BinnedRssi& bins, const Eigen::Vector3d& p_WT) {
  return ((bins.x - p_WT.x()).square() + (bins.y - p_WT.y()).square() +
          (bins.z - p_WT.z()).square())
      .sqrt()
      .max(kNearestAntenna);
}

Eigen::ArrayXd lobe_gains(const BinnedRssi& bins, const Eigen::Vector3d& p_WT) {
  Eigen::ArrayXd gain = Eigen::ArrayXd::Zero(bins.rssi.size());
  if (bins.lobe.beam_width_deg <= 0.0) return gain;
  for (Eigen::Index i = 0; i < gain.size(); ++i) {
    const Eigen::Vector3d p_WA(bins.x[i], bins.y[i], bins.z[i]);
    const Eigen::Vector3d boresight_W = bins.rotations_WA[static_cast<std::size_t>(i)].col(0);
    gain[i] = lobe_db(bins.lobe, boresight_W, p_WT - p_WA);
  }
  return gain;
}

RssiMisfit misfit_at(const BinnedRssi& bins, const PathLossLaw& law, const Eigen::Vector3d& p_WT) {
  RssiMisfit misfit;
  misfit.residuals = bins.weight.sqrt() * (bins.rssi - lobe_gains(bins, p_WT) +
                                           law.slope_db * distances(bins, p_WT).log10());
  misfit.coefficients.setZero(law.pattern_sigma_db > 0.0 ? 2 * kHarmonics : 0,
                              static_cast<Eigen::Index>(bins.spans.size()));
  for (std::size_t k = 0; k < bins.spans.size(); ++k) {
    const TagPhases::Span& span = bins.spans[k];
    const SpanSolver solver = solver_of(bins, law, span, p_WT);
    const double known_dbm = level_of(law, span.antenna).mean_dbm;
    auto part = misfit.residuals.segment(span.begin, span.count);
    const Eigen::VectorXd unknowns = solver.solved(part.matrix(), known_dbm);
    part -= (solver.weighted * unknowns).array();
    const auto gains = unknowns.tail(unknowns.size() - 1);
    misfit.coefficients.col(static_cast<Eigen::Index>(k)) = gains;
    misfit.cost += solver.precision[0] * std::pow(unknowns[0] - known_dbm, 2) +
                   (solver.precision.tail(gains.size()).array() * gains.array().square()).sum();
    misfit.log_determinant += log_determinant_of(solver);
  }
  misfit.cost += misfit.residuals.square().sum();
  return misfit;
}

RssiParabola parabola_at(const BinnedRssi& bins, const PathLossLaw& law,
                         const Eigen::Vector3d& p_WT) {
  const Eigen::ArrayXd root = bins.weight.sqrt();
  // The first plus the second times the slope is fitted.
  Eigen::MatrixX2d values(bins.rssi.size(), 2);
  values.col(0) = root * (bins.rssi - lobe_gains(bins, p_WT));
  values.col(1) = root * distances(bins, p_WT).log10();
  Eigen::Matrix2d sums = values.transpose() * values;
  RssiParabola parabola;
  for (const TagPhases::Span& span : bins.spans) {
    const SpanSolver solver = solver_of(bins, law, span, p_WT);
    const double known_dbm = level_of(law, span.antenna).mean_dbm;
    Eigen::MatrixX2d right =
        solver.weighted.transpose() * values.middleRows(span.begin, span.count);
    right(0, 0) += solver.precision[0] * known_dbm;
    sums(0, 0) += solver.precision[0] * known_dbm * known_dbm;
    sums -= right.transpose() * solver.normal.solve(right);
    parabola.log_determinant += log_determinant_of(solver);
  }
  parabola.constant = sums(0, 0);
  parabola.linear = 2.0 * sums(0, 1);
  parabola.quadratic = sums(1, 1);
  return parabola;
}

RssiNormal normal_at(const BinnedRssi& bins, const PathLossLaw& law, const Eigen::Vector3d& p_WT,
                     const RssiMisfit& misfit) {
  const Eigen::ArrayXd square = distances(bins, p_WT).square();
  const double factor = -law.slope_db / std::log(10.0);
  const Eigen::ArrayXd root = bins.weight.sqrt();
  Eigen::MatrixX3d slopes(bins.rssi.size(), 3);
  slopes.leftCols<2>() = gain_slopes(bins, misfit, p_WT);
  slopes.col(0).array() +=
      factor * (p_WT.x() - bins.x) / square + lobe_slopes(bins, p_WT, Eigen::Vector3d::UnitX());
  slopes.col(1).array() +=
      factor * (p_WT.y() - bins.y) / square + lobe_slopes(bins, p_WT, Eigen::Vector3d::UnitY());
  slopes.col(2) = -0.5 * square.log10();
  slopes = root.matrix().asDiagonal() * slopes;
  RssiNormal normal;
  for (const TagPhases::Span& span : bins.spans) {
    const SpanSolver solver = solver_of(bins, law, span, p_WT);
    const auto part = slopes.middleRows(span.begin, span.count);
    const Eigen::MatrixX3d product = solver.weighted.transpose() * part;
    normal.matrix += part.transpose() * part - product.transpose() * solver.normal.solve(product);
    normal.gradient +=
        part.leftCols<2>().transpose() * misfit.residuals.segment(span.begin, span.count).matrix();
  }
  return normal;
}

double rssi_noise(const BinnedRssi& bins, const RssiMisfit& misfit) {
  // Gains absorb some of the noise, which shows in what they deviate from their prior.
  const double squares = misfit.residuals.square().sum();
  const double absorbed = squares > 0.0 ? misfit.cost / squares : 1.0;
  const double variance = absorbed * residual_variance(bins.spans, misfit.residuals);
  const double correlation = correlation_factor(bins.spans, misfit.residuals);
  const double away = fitted_away(correlation);
  return std::max(variance, kMinRssiNoise * kMinRssiNoise) * correlation * away * away;
}

}  // namespace tagfield
