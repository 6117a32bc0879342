// SPDX-License-Identifier: Apache-2.0
/// @file
/// The steps of the joint estimate.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/localization/joint/joint_system.h"
#include "tagfield/localization/phase_curves/least_squares.h"
#include "tagfield/localization/problem.h"
#include "tagfield/localization/tag_estimate.h"

namespace tagfield {

/// Rounds of minimize() from a place that is far off.
inline constexpr int kMostRoundsOfJointFit = 25;

struct JointState {
  const LocalizationProblem* problem = nullptr;
  JointSystem system;
  std::vector<const SamplesOfTag*> samples;          ///< By tag of the system.
  std::vector<std::vector<Candidate>> alternatives;  ///< Likewise: other places that may be.
  std::map<std::string, TagEstimate> not_located;    ///< Tags that can't be in the system.
};

/// Each tag by itself on its unwrapped phase, and knots for the pose error.
JointState begin_jointly(const LocalizationProblem& problem, int threads);

/// Phase noise [rad] before any fit, from how phases change from read to read.
double first_noise(const LocalizationProblem& problem);

/// A tag that is about at a place; of a reference tag, just there.
struct PlacedTag {
  std::string id;
  const SamplesOfTag* samples = nullptr;
  Eigen::Vector3d p_WT;
};

/// Tags on their wrapped phases from where they are placed, and knots for the pose error.
JointState begin_at(const LocalizationProblem& problem, const std::vector<PlacedTag>& placed);

/// Takes these samples for the tag's own, on their wrapped phase, with the offsets that suit its
/// place and the corrected poses. They must live as long as the state.
void take_samples(JointState& state, std::size_t tag, const SamplesOfTag& samples);

/// Minimizes, learns the phase noise from it, and gives tags that don't fit less weight.
void fit_unwrapped_jointly(JointState& state, int threads);

/// Strength and time constant of the pose error by which the reads are most likely.
void learn_pose_error(JointState& state, int threads);

/// Calls `use(index, fit)` for each tag but reference tags, by several threads: the tag by itself
/// on its unwrapped phase, as if the corrected poses were the believed ones. No fit is kept, as
/// those of all tags take as much memory as their reads.
void for_each_corrected_fit(const JointState& state, int threads,
                            const std::function<void(std::size_t, const UnwrappedFit&)>& use);

/// The best fit of each tag by itself, where there is one.
using BestFits = std::vector<std::optional<TagFit>>;

/// Puts tags to fits elsewhere that cost less than `better` of what they do where they stand, and
/// minimizes. Whether there was any.
bool go_on_from(JointState& state, const BestFits& best, double better, int threads);

/// Looks for each tag's place anew from the corrected poses, and goes on from better ones.
void find_better_places(JointState& state, int threads);

/// Exchanges unwrapped phases by wrapped ones, tag by tag where they fit as well, and minimizes.
void fit_wrapped_jointly(JointState& state, int threads);

/// Other places that explain the reads nearly as well: of single tags with the corrected poses, and
/// of all tags mirrored across a straight way, and of tags that were read from a straight stretch.
/// Where one explains them far better than where a tag stands, the tag goes there first.
void find_alternatives(JointState& state, int threads);

/// Where a tag stands, with the covariance of its unknowns.
Candidate candidate_of(const JointSystem& system, std::size_t tag,
                       const Eigen::Matrix3d& covariance);

}  // namespace tagfield
