// SPDX-License-Identifier: Apache-2.0
/// @file
/// Whether places by phase can be believed at all, whatever method found them: chance makes some
/// waves agree somewhere, and a phase of the wrong sign fits somewhere, too.
#pragma once

#include "tagfield/localization/method.h"

namespace tagfield {

/// ln of the probability, bounded from above, that at least one of `places` different places
/// explains phases of any value as well: the waves of apertures with n_g reads, an offset each,
/// that add up to `sum` = Σ|S_g|. Chernoff's bound, min over λ of Σ ln E e^(λ|S_g|) − λ sum, with
/// |S_g| = 1 of one wave, 2|cos| of half a random angle of two, and Rayleigh's law of more. Offsets
/// that are free thereby count: of one read each, the sum is that of all reads for any phases.
double log_chance(const std::vector<double>& reads, double sum, double places);

/// Refuses all tags: no read has a phase.
void refuse_without_phases(const LocalizationProblem& problem, LocalizationResult& result);

/// Refuses tags whose best place chance explains with a probability of over 1e-4: over apertures of
/// any length none fits better.
void refuse_chance(const LocalizationProblem& problem, LocalizationResult& result);

/// Refuses tags of which over a quarter of the phases belong nowhere, while the others fit: those
/// are of another tag, or at other times of another place. Not of methods that correct poses, whose
/// residuals are not those of the believed ones.
void refuse_mixtures(const LocalizationProblem& problem, LocalizationResult& result);

/// Likewise of places by signal strength: by the place that most waves agree on.
void refuse_mixtures_by_phase(const LocalizationProblem& problem, LocalizationResult& result);

/// Tags within 0.5 m of a straight way's line: the mirror image beyond it is as likely and may be
/// so near that methods take both for one place, and ahead of the way or behind it places far from
/// each other show the same phases. The covariance gets the mean square over all places about, each
/// as likely as the phases say.
void span_line(const LocalizationProblem& problem, LocalizationResult& result);

/// Where most of some tags' phases fit a place much better with the other sign: warns, and refuses
/// all places.
void refuse_wrong_sign(const LocalizationProblem& problem, LocalizationResult& result,
                       Diagnostics& diagnostics);

}  // namespace tagfield
