// SPDX-License-Identifier: Apache-2.0
/// @file
/// Statistics of the residuals of a fit: how uncertain it is, and whether another position is
/// significantly worse. Phase noise is independent from read to read, but pose errors are not.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/localization/tag_phases.h"

namespace tagfield {

/// Spans of reads, each fitted with its own offset.
using Spans = std::vector<TagPhases::Span>;

/// Number of correlated residuals equivalent to one independent residual, at least 1: the
/// integrated autocorrelation time 1 + 2 Σ ρ_k over the lags before the first ρ_k ≤ 0.
double correlation_factor(const Spans& spans, const Eigen::ArrayXd& residuals);

/// Ratio of a fit's actual errors to those that its residuals suggest, 1 to 2: slow errors that no
/// model explains are partly taken for distance. Errors due to reflections, correlated over a metre
/// or two of the path, were twice as large (docs/methods.md); white noise is not absorbed.
double fitted_away(double correlation_factor);
double fitted_away(const Spans& spans, const Eigen::ArrayXd& residuals);

/// Noise of a single residual [m], from the differences of neighbours in a span, which slow errors
/// hardly affect: √(½ mean Δ²). 0 if there are no neighbours.
double noise_of_one(const Spans& spans, const Eigen::ArrayXd& residuals);

/// Variance of one residual [m²], corrected for the degrees of freedom of the fitted position and
/// offsets.
double residual_variance(const Spans& spans, const Eigen::ArrayXd& residuals);

/// Whether a position with residuals `other` is significantly worse than one with residuals `best`,
/// beyond what chance could cause. With n/τ independent reads and Δ = Σ(other² − best²)/(σ² τ), all
/// of the following must hold:
///   - the squares differ by more than noise: Δ > 16;
///   - not by errors that both share: Δ > 4 · 2 √(Σ(other − best)²/(σ² τ)) (after Vuong,
///     Econometrica 57, 1989);
///   - not by few slow errors: ln(Σ other² / Σ best²) > 4 · 2 / √(n/τ), four standard deviations
///     of the logarithm of a ratio of two variances.
bool tells_apart(const Spans& spans, const Eigen::ArrayXd& best, const Eigen::ArrayXd& other);

}  // namespace tagfield
