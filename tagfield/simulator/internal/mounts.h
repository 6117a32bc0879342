// SPDX-License-Identifier: Apache-2.0
/// @file
/// Poses of antennas and tags from their specifications: on lifts, or from the rows of a recording.
#pragma once

#include <vector>

#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Whether the antenna never moves: on no robot, without a lift, not recorded.
bool is_fixed(const AntennaSpec& antenna);

/// The row valid at `stamp`; the first one if `stamp` is before it. `rows` must not be empty.
const StampedPose& row_at(const Trajectory& rows, Time stamp);

std::vector<Time> stamps_of(const Trajectory& rows);

/// X_PA at `stamp`, including the lift's height.
RigidTransform mount_at(const AntennaSpec& antenna, Time stamp);

}  // namespace tagfield
