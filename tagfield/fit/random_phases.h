// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a fit to phases is worth against the thought that they are random: its Bayes factor, which
/// over random phases is 1 in the mean, so that one of 100 or more comes from them in one case of a
/// hundred at most (Markov's inequality), however long was searched for it.
///
///   log B = Σ log 2π f(e) + Σ of each offset log √(2π) σ/(2π √n) + ½ log (det C / det C₀) − ½ θᵀ
///   C₀⁻¹ θ
///           + what the noise's own prior costs (Laplace's approximation: MacKay, Neural
///           Computation 4, 1992)
///
/// with f the wrapped normal density of residuals e, a twentieth of it uniform for reads that
/// belong nowhere; n reads under each offset, which may be anywhere in a turn; unknowns θ of
/// covariance C after and C₀ before.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace tagfield {

/// Phases as good as random [rad].
inline constexpr double kMostPhaseNoise_rad = 2.0;

/// log B from which on a fit is believed: log 100.
inline const double kLeastEvidence = std::log(100.0);

/// Σ log 2π f(e) of residuals in (−π, π] with a noise [rad] that was estimated from them, anywhere
/// between `least_noise_rad` and kMostPhaseNoise_rad.
double evidence_of_residuals(const std::vector<double>& residuals, double noise_rad,
                             double least_noise_rad);

/// Of an offset that `count` reads have told, at most 0.
double evidence_of_offset(std::size_t count, double noise_rad);

}  // namespace tagfield
