// SPDX-License-Identifier: Apache-2.0
/// @file
/// Jumps of the believed poses, as when a filter corrects itself or a loop is closed.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tagfield/localization/method.h"
#include "tagfield/localization/problem.h"

namespace tagfield {

/// A step between two poses that the antenna can't have driven.
struct PoseJump {
  Time from, to;         ///< Stamps of the poses before and after.
  double size_m = 0.0;   ///< Horizontal distance from where its motion leads.
  Eigen::Vector2d p_WA;  ///< Position before it [m].
  /// It is larger than what was driven since the start, or since the relocation before: so far off
  /// the antenna can't have been, unless it was carried or its place was unknown. The poses before
  /// it are then wrong, and those after it right.
  bool is_relocation = false;
};

/// The jumps of a trajectory that is sorted by time. The motion before and after a step (the mean
/// of its neighbours' velocities) predicts it. A jump is off by over 3 cm, a tenth of a wavelength;
/// by more than driving explains: one and a half times what the antenna drives meanwhile at its
/// usual highest speed (95 % of its steps are slower), or what one sudden change of its velocity
/// and half of g can do in so short a time; and by over three times what 95 % of the steps are off
/// by, which normal noise of the poses exceeds in one step of 10¹¹.
std::vector<PoseJump> pose_jumps(const Trajectory& X_WA);

/// Antennas of one body, whose poses jump together.
struct JumpingBody {
  std::vector<std::string> antennas;
  std::vector<PoseJump> jumps;  ///< In order of time, apart from each other.
};

/// The bodies whose poses jump. A jump of any of its antennas is one of the body, with the size of
/// the largest.
std::vector<JumpingBody> jumping_bodies(const LocalizationProblem& problem);

/// Leaves of each tag's reads by a body's antennas those between two jumps, where most of them are,
/// after a relocation if there are any, and none amid a jump. Jumps with reads on one side only
/// have no other effect, and are removed from `bodies`.
///
/// Returns by tag the standard deviation [m] of its position due to jumps. After the last
/// relocation it is √(min(1, 2 (1 − w)) J²), for jumps of the mean square J² and the share w of all
/// reads there that are on the tag's side. Nothing shows which side is right: where half of the
/// reads are elsewhere, a tag may be off by a whole jump; the fewer are, the less likely the frame
/// is theirs. A tag that is read only before a relocation may be off by all of it.
std::map<std::string, double> keep_one_side(std::vector<JumpingBody>& bodies,
                                            SamplesByTag& samples);

/// Adds LocalizationProblem::pose_jump_m to each position, alike in both directions.
void add_pose_jumps(const LocalizationProblem& problem, LocalizationResult& result);

/// Warns of jumps: how many, and when, where and how large the largest one is. Antennas of a robot
/// jump together, so only those of the antenna or body with most of them are reported.
void warn_of_pose_jumps(const std::map<std::string, BelievedTrack>& tracks,
                        Diagnostics& diagnostics);
void warn_of_pose_jumps(const std::vector<JumpingBody>& bodies, Diagnostics& diagnostics);

}  // namespace tagfield
