// SPDX-License-Identifier: Apache-2.0
/// @file
/// Motions from an earlier run's tables, to be replayed.
#pragma once

#include <string>
#include <vector>

#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Reads the rows of `antenna` from a table of poses (`stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw`).
/// Throws Error "FILE:LINE: …" on a table that is malformed, and "FILE: …" if it has no row of that
/// antenna or its stamps don't rise.
Trajectory read_recorded_antenna(const std::string& path, const std::string& antenna);

/// Gives the tags the motions in a table of positions (`stamp_s,tag,x_m,y_m,z_m`): each row holds
/// from its stamp until the tag's next. A tag of the table appears with its first row, and is added
/// at the end of `tags` if it is not among them; its position there, and what it was on, no longer
/// count. It stays turned as it first is in the world, and as the world is where it was on a robot.
/// Throws Error as read_recorded_antenna().
void replay_tags(const std::string& path, std::vector<TagSpec>& tags);

/// Latest stamp of all recorded antennas; none where no antenna is recorded.
std::optional<Time> end_of_recordings(const std::vector<AntennaSpec>& antennas);

}  // namespace tagfield
