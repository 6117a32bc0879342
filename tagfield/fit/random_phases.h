// SPDX-License-Identifier: Apache-2.0
/// @file
/// Evidence of a fit to phases against the hypothesis that they are random: its Bayes factor. Its
/// mean over random phases is 1, so that they give a factor of 100 or more in at most one case in a
/// hundred (Markov's inequality), however long the search for the fit.
///
///   log B = Σ log 2π f(e) + Σ over offsets log √(2π) σ/(2π √n) + ½ log (det C / det C₀)
///           − ½ θᵀ C₀⁻¹ θ + the cost of the noise's own prior
///           (Laplace's approximation: MacKay, Neural Computation 4, 1992)
///
/// with f the wrapped normal density of residuals e, mixed with a uniform share of a twentieth for
/// outliers; n reads for each offset, which has a uniform prior over 2π; unknowns θ with posterior
/// covariance C and prior covariance C₀.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace tagfield {

/// Noise at which phases are practically random [rad].
inline constexpr double kMaxPhaseNoise_rad = 2.0;

/// Least log B of a credible fit: log 100.
inline const double kMinEvidence = std::log(100.0);

/// Σ log 2π f(e) of residuals in (−π, π], and the cost of the prior of their noise [rad], which was
/// estimated from them and may be anywhere between `min_noise_rad` and kMaxPhaseNoise_rad.
double evidence_of_residuals(const std::vector<double>& residuals, double noise_rad,
                             double min_noise_rad);

/// Contribution of an offset that was estimated from `count` reads; at most 0.
double evidence_of_offset(std::size_t count, double noise_rad);

}  // namespace tagfield
