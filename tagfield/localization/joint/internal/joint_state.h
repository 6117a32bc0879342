// SPDX-License-Identifier: Apache-2.0
/// @file
/// Steps of the joint estimate.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tagfield/localization/joint/joint_system.h"
#include "tagfield/localization/phase_curves/least_squares.h"
#include "tagfield/localization/problem.h"
#include "tagfield/localization/tag_estimate.h"

namespace tagfield {

/// Maximum rounds of minimize() from a distant start.
inline constexpr int kMaxRoundsOfJointFit = 25;

struct JointState {
  const LocalizationProblem* problem = nullptr;
  JointSystem system;
  std::vector<const SamplesOfTag*> samples;          ///< Per tag of the system.
  std::vector<std::vector<Candidate>> alternatives;  ///< Per tag: other possible positions.
  std::map<std::string, TagEstimate> not_located;    ///< Tags that cannot be in the system.
};

/// Fits each tag but those in `without` separately to its unwrapped phase, and sets up the knots of
/// the pose error.
JointState begin_jointly(const LocalizationProblem& problem, const std::set<std::string>& without,
                         int threads);

/// Phase noise [rad] before any fit, from phase changes between successive reads.
double first_noise(const LocalizationProblem& problem);

/// A tag at an approximate position; for a reference tag, the exact one.
struct PlacedTag {
  std::string id;
  const SamplesOfTag* samples = nullptr;
  Eigen::Vector3d p_WT;
};

/// Sets up tags with wrapped phases at their given positions, and the knots of the pose error.
JointState begin_at(const LocalizationProblem& problem, const std::vector<PlacedTag>& placed);

/// Replaces the tag's samples and uses their wrapped phase, with the offsets that fit its position
/// and the corrected poses. `samples` must outlive the state.
void take_samples(JointState& state, std::size_t tag, const SamplesOfTag& samples);

/// Minimizes, estimates the phase noise from the residuals, and reduces the weight of tags that do
/// not fit.
void fit_unwrapped_jointly(JointState& state, int threads);

/// Sets the magnitude and time constant of the pose error that maximize the evidence.
void learn_pose_error(JointState& state, int threads);

/// Calls `use(index, fit)` for each tag except reference tags, from several threads, with the fit
/// of the tag alone to its unwrapped phase and the corrected poses. Fits are not kept, as those of
/// all tags take as much memory as their reads.
void for_each_corrected_fit(const JointState& state, int threads,
                            const std::function<void(std::size_t, const UnwrappedFit&)>& use);

/// The best separate fit of each tag, if any.
using BestFits = std::vector<std::optional<TagFit>>;

/// Moves tags to fits at other positions that cost less than `better` times the current cost, and
/// minimizes. Returns whether any tag was moved.
bool go_on_from(JointState& state, const BestFits& best, double better, int threads);

/// Searches again for each tag's position with the corrected poses, and continues from better ones.
void find_better_positions(JointState& state, int threads);

/// Replaces unwrapped by wrapped phases, for each tag where they fit as well, and minimizes.
void fit_wrapped_jointly(JointState& state, int threads);

/// Finds other positions that explain the reads nearly as well: of single tags with the corrected
/// poses, of all tags mirrored across a straight path, and of tags read only from a straight
/// section. If another position explains a tag's reads far better, the tag is moved there first.
void find_alternatives(JointState& state, int threads);

/// Current position of a tag, given the covariance of its unknowns.
Candidate candidate_of(const JointSystem& system, std::size_t tag,
                       const Eigen::Matrix3d& covariance);

}  // namespace tagfield
