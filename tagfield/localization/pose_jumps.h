// SPDX-License-Identifier: Apache-2.0
/// @file
/// Jumps of the believed poses, as when a filter corrects itself or a loop is closed.
#pragma once

#include <map>
#include <string>
#include <vector>

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

/// Warns of an antenna's jumps, if there are any: how many, and when, where and how large the
/// largest one is.
void warn_of_pose_jumps(const std::string& antenna, const std::vector<PoseJump>& jumps,
                        Diagnostics& diagnostics);

/// Same. Antennas of a robot jump together, so only those of the antenna with most of them are
/// reported.
void warn_of_pose_jumps(const std::map<std::string, BelievedTrack>& tracks,
                        Diagnostics& diagnostics);

}  // namespace tagfield
