// SPDX-License-Identifier: Apache-2.0
/// @file
/// What the residuals of a fit say about it: how uncertain it is, and whether another place is
/// really worse. Phase noise is independent from read to read, but pose errors are not.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/localization/tag_phases.h"

namespace tagfield {

/// Stretches of reads whose errors are fitted with an offset each.
using Spans = std::vector<TagPhases::Span>;

/// How many correlated residuals are worth one independent one, at least 1: the integrated
/// autocorrelation time 1 + 2 Σ ρ_k over the lags before the first ρ_k ≤ 0.
double correlation_factor(const Spans& spans, const Eigen::ArrayXd& residuals);

/// Noise of one residual [m], from the differences of neighbours in a span, which slow errors leave
/// alone: √(½ mean Δ²). 0 where there are no neighbours.
double noise_of_one(const Spans& spans, const Eigen::ArrayXd& residuals);

/// Variance of one residual [m²], the fitted place and offsets allowed for.
double residual_variance(const Spans& spans, const Eigen::ArrayXd& residuals);

/// False where a place with residuals `other` explains the data so nearly as well as one with
/// residuals `best` that chance could be the reason. To tell them apart all must hold, with
/// Δ = Σ(other² − best²)/(σ² τ) and n/τ independent reads:
///   - the squares differ by more than noise: Δ > 16;
///   - not by errors that both share: Δ > 4 · 2 √(Σ(other − best)²/(σ² τ)) (after Vuong,
///     Econometrica 57, 1989);
///   - not by few slow errors: ln(Σ other² / Σ best²) > 4 · 2 / √(n/τ), four standard deviations
///     of the logarithm of a ratio of two variances.
bool tells_apart(const Spans& spans, const Eigen::ArrayXd& best, const Eigen::ArrayXd& other);

}  // namespace tagfield
