// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where antennas and tags are by their specifications: on lifts, and by the rows of a recording.
#pragma once

#include <vector>

#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Whether it stays where it is: on no robot, without a lift, not recorded.
bool is_fixed(const AntennaSpec& antenna);

/// The row that holds at `stamp`; the first one before them all. `rows` must not be empty.
const StampedPose& row_at(const Trajectory& rows, Time stamp);

std::vector<Time> stamps_of(const Trajectory& rows);

/// X_PA at `stamp`, the lift's height included.
RigidTransform mount_at(const AntennaSpec& antenna, Time stamp);

}  // namespace tagfield
