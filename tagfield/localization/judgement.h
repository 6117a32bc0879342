// SPDX-License-Identifier: Apache-2.0
/// @file
/// Verdicts common to all methods: why a tag can't be located at all, and whether candidates are
/// acceptable.
#pragma once

#include <string>
#include <vector>

#include "tagfield/localization/problem.h"
#include "tagfield/localization/tag_estimate.h"

namespace tagfield {

/// Assumed if no pose error is stated.
inline constexpr PoseErrorModel kUsualPoseError{0.02, 0.02, 5.0};

/// ln 100: log evidence required that RSSI follows a path-loss law; chance reaches it in one case
/// in a hundred.
inline constexpr double kMinLogEvidence = 4.6;

/// Minimum number of reads to locate a tag.
inline constexpr std::size_t kFewestReads = 8;

/// Minimum number of reads in excess of the unknowns: with fewer, a fit follows the noise and seems
/// better than it is, and many positions fit by chance.
inline constexpr std::size_t kFewestSpare = 16;

/// An antenna that moved less than this [m] counts as stationary.
inline constexpr double kStillExtent = 0.1;

/// Extent of an antenna's positions, the diagonal of their bounding box [m].
double extent_of(const std::vector<PhaseSample>& samples);

/// Number of reads over all antennas.
std::size_t count_reads(const SamplesOfTag& samples);

/// Why a tag can't be located from these samples by the phase of a moving antenna; empty if it
/// might be.
std::string why_not_locatable(const SamplesOfTag& samples);

/// Whether poses are stated to be exact, so that no method corrects them.
bool has_exact_poses(const LocalizationProblem& problem);

/// Whether nothing is known of the poses' error, neither a model nor how dead reckoning drifts.
bool is_pose_error_unknown(const LocalizationProblem& problem);

/// A new estimate with only the tag and the number of reads filled in.
TagEstimate begun(const std::string& tag, const SamplesOfTag& samples);

/// The estimate without candidates, with the reason "cannot localize: WHY".
TagEstimate not_located(TagEstimate estimate, const std::string& why);

/// Adds a position error that the candidate's covariance does not include, with this covariance in
/// x and y, or in all three directions [m²]. The expected error is a horizontal one.
void add_error(const Eigen::Matrix2d& covariance, Candidate& candidate);
void add_error(const Eigen::Matrix3d& covariance, Candidate& candidate);

/// Sets verdict and reason from the candidates, best first; there must be at least one.
void judge(const EstimateLimits& limits, TagEstimate& estimate);

}  // namespace tagfield
