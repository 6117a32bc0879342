// SPDX-License-Identifier: Apache-2.0
/// @file
/// Fit of a path-loss law to one tag's RSSI, for a given position of the tag:
/// RSSI = A − s log₁₀ r + g, with a level A for each antenna, a slope s, and gains g of both ends,
/// which vary slowly with direction in a way that nobody states. docs/methods.md has the equations.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "tagfield/localization/problem.h"
#include "tagfield/localization/residuals.h"
#include "tagfield/localization/signal_strength/lobe.h"

namespace tagfield {

/// RSSI of one tag, averaged over short sections of the antennas' paths, grouped by antenna.
struct BinnedRssi {
  Eigen::ArrayXd x, y, z;                     ///< Mean positions of the antenna [m], in frame W.
  Eigen::ArrayXd rssi;                        ///< [dBm].
  Eigen::ArrayXd weight;                      ///< 1 for four reads and more.
  Spans spans;                                ///< Of each antenna.
  std::vector<Eigen::Matrix3d> rotations_WA;  ///< Of the antennas' frames.
  Lobe lobe;
  double noise_db2 = 0.25;  ///< Variance of the noise from one bin to the next [dB²].
};

/// With RSSI from fewer positions nothing is located.
inline constexpr Eigen::Index kFewestRssiBins = 6;

/// Lower bound on the error of a mean of many reads [dB], due to reflections.
inline constexpr double kMinRssiNoise = 0.5;

/// Bins spanning at most `bin_m` [m].
BinnedRssi binned_rssi(const LocalizationProblem& problem, const SamplesOfTag& samples,
                       double bin_m, const Lobe& lobe);

/// Prior of an antenna's level [dBm at 1 m].
struct RssiLevel {
  double mean_dbm = 0.0;
  double precision = 0.0;  ///< 1/variance [1/dB²], in units of the bins' noise; 0: unknown.
};

struct PathLossLaw {
  double slope_db = 40.0;                   ///< Per decade of distance, over 0.
  std::map<std::string, RssiLevel> levels;  ///< By antenna.
  double slope_sigma_db = 0.0;              ///< Standard deviation of the slope.
  /// Standard deviation of each coefficient of the gains' dependence on direction [dB], for both
  /// ends; 0: the same gain in all directions.
  double pattern_sigma_db = 0.0;
};

/// Distances from a position of the tag [m], at least 5 cm.
Eigen::ArrayXd distances(const BinnedRssi& bins, const Eigen::Vector3d& p_WT);

/// Gains of the antennas' lobes towards a position [dB]; zeros if none is stated.
Eigen::ArrayXd lobe_gains(const BinnedRssi& bins, const Eigen::Vector3d& p_WT);

/// What a law leaves of a tag's RSSI, with the most probable levels and gains.
struct RssiMisfit {
  Eigen::ArrayXd residuals;      ///< Times the square root of the weight [dB].
  Eigen::MatrixXd coefficients;  ///< Of the gains, a column for each span.
  double cost = 0.0;  ///< Squares of residuals and of what levels and gains deviate [dB²].
  /// Of levels and gains over their prior; Occam's factor is −½ of it.
  double log_determinant = 0.0;
};

RssiMisfit misfit_at(const BinnedRssi& bins, const PathLossLaw& law, const Eigen::Vector3d& p_WT);

/// Cost as a function of the slope s, constant + linear s + quadratic s², for a law's other
/// properties.
struct RssiParabola {
  double constant = 0.0, linear = 0.0, quadratic = 0.0;
  double log_determinant = 0.0;  ///< As RssiMisfit's.
};

RssiParabola parabola_at(const BinnedRssi& bins, const PathLossLaw& law,
                         const Eigen::Vector3d& p_WT);

/// Σ J Jᵀ for x, y [m] and the slope [dB] with levels and gains eliminated, and the gradient for x
/// and y.
struct RssiNormal {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
};

RssiNormal normal_at(const BinnedRssi& bins, const PathLossLaw& law, const Eigen::Vector3d& p_WT,
                     const RssiMisfit& misfit);

/// Variance that a position's covariance is worth [dB²]: that of a residual, at least of half a
/// decibel, times the residuals' correlation factor and the square of what is fitted_away().
double rssi_noise(const BinnedRssi& bins, const RssiMisfit& misfit);

}  // namespace tagfield
