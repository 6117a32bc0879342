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
};

/// The jumps of a trajectory that is sorted by time. The motion before and after a step (the mean
/// of its neighbours' velocities) predicts it. A jump is off by over 3 cm, a tenth of a wavelength;
/// by over one and a half times what the antenna drives meanwhile at its usual highest speed (95 %
/// of its steps are slower), which no stop, start or turn explains; and by over three times what 95
/// % of the steps are off by, which normal noise of the poses exceeds in one step of 10¹¹.
std::vector<PoseJump> pose_jumps(const Trajectory& X_WA);

/// Warns of jumps: how many, and when, where and how large the largest one is. Antennas of a robot
/// jump together, so only those of the antenna with most of them are reported.
void warn_of_pose_jumps(const std::map<std::string, BelievedTrack>& tracks,
                        Diagnostics& diagnostics);

}  // namespace tagfield
