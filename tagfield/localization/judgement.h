// SPDX-License-Identifier: Apache-2.0
/// @file
/// What all methods have in common when they judge: why a tag can't be located at all, and whether
/// candidates are an answer.
#pragma once

#include <string>
#include <vector>

#include "tagfield/localization/problem.h"
#include "tagfield/localization/tag_estimate.h"

namespace tagfield {

/// Of poses of which nothing is told.
inline constexpr PoseErrorModel kUsualPoseError{0.02, 0.02, 5.0};

/// ln 100, by which strengths must go by a law of distance: chance makes so much in one case of a
/// hundred.
inline constexpr double kLeastLogEvidence = 4.6;

/// Fewer reads of a tag than this locate nothing.
inline constexpr std::size_t kFewestReads = 8;

/// Reads beyond one for each unknown; a fit to fewer follows the noise and seems better than it is,
/// and fewer fit many places by chance.
inline constexpr std::size_t kFewestSpare = 16;

/// An antenna that moved less than this [m] stood still.
inline constexpr double kStillExtent = 0.1;

/// Largest extent of an antenna's places, the diagonal of the box around them [m].
double extent_of(const std::vector<PhaseSample>& samples);

/// Over all antennas.
std::size_t count_reads(const SamplesOfTag& samples);

/// Why these samples can't locate anything by the phase of a moving antenna; empty if they might.
std::string why_hopeless(const SamplesOfTag& samples);

/// Whether poses are told to be exact, so that no method corrects them.
bool has_exact_poses(const LocalizationProblem& problem);

/// An estimate that says nothing yet but how many reads there are.
TagEstimate begun(const std::string& tag, const SamplesOfTag& samples);

/// The estimate without candidates, with the reason "cannot localize: WHY".
TagEstimate not_located(TagEstimate estimate, const std::string& why);

/// Adds an error of the place that the candidate does not know of, of this covariance in x and y
/// [m²].
void add_error(const Eigen::Matrix2d& covariance, Candidate& candidate);

/// Sets verdict and reason by the candidates, of which there is at least one, best first.
void judge(const EstimateLimits& limits, TagEstimate& estimate);

}  // namespace tagfield
