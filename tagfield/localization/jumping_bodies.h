// SPDX-License-Identifier: Apache-2.0
/// @file
/// What jumps of the believed poses (pose_jumps.h) mean for tags that are read before and after
/// them: docs/estimators.md.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tagfield/localization/method.h"
#include "tagfield/localization/pose_jumps.h"
#include "tagfield/localization/problem.h"

namespace tagfield {

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

/// As for a single antenna; of several bodies that jump, for the one that does so most often.
void warn_of_pose_jumps(const std::vector<JumpingBody>& bodies, Diagnostics& diagnostics);

}  // namespace tagfield
