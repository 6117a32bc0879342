// SPDX-License-Identifier: Apache-2.0
/// @file
/// Plausibility checks of positions by phase, whatever method found them: even random phasors add
/// up somewhere, and phases of the wrong sign also fit some position.
#pragma once

#include "tagfield/localization/method.h"

namespace tagfield {

/// Upper bound on ln of the probability that at least one of `places` different positions explains
/// random phases as well as the measured ones: that the phasors of apertures with n_g reads and one
/// free offset each add up to at least `sum` = Σ|S_g|. Chernoff's bound, min over λ of Σ ln E
/// e^(λ|S_g|) − λ sum, with |S_g| = 1 for one read, 2|cos| of half a random angle for two, and
/// Rayleigh's distribution for more. Free offsets thereby count as degrees of freedom: with one
/// read per aperture the sum is the number of reads for any phases.
double log_chance(const std::vector<double>& reads, double sum, double places);

/// Refuses all tags: no read has a phase.
void refuse_without_phases(const LocalizationProblem& problem, LocalizationResult& result);

/// Refuses tags whose best position random phases would explain as well with a probability over
/// 1e-4, at every aperture length tried.
void refuse_chance(const LocalizationProblem& problem, LocalizationResult& result);

/// Refuses tags of which over a quarter of the phases are outliers while the rest fits: the
/// outliers are reads of another tag, or the tag was elsewhere at times. Does not apply to methods
/// that correct poses, whose residuals do not refer to the believed poses.
void refuse_mixtures(const LocalizationProblem& problem, LocalizationResult& result);

/// As above, but for positions by signal strength: uses the residuals at the position that most
/// phasors agree on.
void refuse_mixtures_by_phase(const LocalizationProblem& problem, LocalizationResult& result);

/// Widens the covariance of tags within 0.5 m of the line of a straight path: the mirror image is
/// equally likely and may be so near that methods take both for one position, and ahead of the path
/// or behind it distant positions have the same phases. Adds the mean square deviation over all
/// positions nearby, weighted by their likelihood.
void span_line(const LocalizationProblem& problem, LocalizationResult& result);

/// Warns and refuses all positions if the phases of most tags examined fit a position much better
/// with the opposite sign.
void refuse_wrong_sign(const LocalizationProblem& problem, LocalizationResult& result,
                       Diagnostics& diagnostics);

}  // namespace tagfield
