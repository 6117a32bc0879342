// SPDX-License-Identifier: Apache-2.0
/// @file
/// Motions from an earlier run's tables, to be replayed.
#pragma once

#include <string>
#include <vector>

#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Reads the rows of `antenna` from a table of poses (`stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw`).
/// Throws Error "FILE:LINE: …" on a malformed table, and "FILE: …" if it has no row of that antenna
/// or its timestamps don't increase.
Trajectory read_recorded_antenna(const std::string& path, const std::string& antenna);

/// Replaces the tags' motions by those in a table of positions (`stamp_s,tag,x_m,y_m,z_m`): each
/// row holds from its timestamp until the tag's next one. A tag of the table appears with its first
/// row, and is appended to `tags` if it is not among them. Its position and parent from the
/// scenario are dropped. It keeps its initial orientation in the world; a tag that was on a robot
/// is aligned with the world axes. Throws Error as read_recorded_antenna().
void replay_tags(const std::string& path, std::vector<TagSpec>& tags);

/// Latest timestamp of all recorded antennas; none if no antenna is recorded.
std::optional<Time> end_of_recordings(const std::vector<AntennaSpec>& antennas);

}  // namespace tagfield
