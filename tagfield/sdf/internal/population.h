// SPDX-License-Identifier: Apache-2.0
/// @file
/// Copies of a model that a world distributes over a region: its <population>, as Gazebo 11 does.
#pragma once

#include <tinyxml2.h>

#include <Eigen/Core>
#include <vector>

#include "tagfield/sdf/internal/context.h"

namespace tagfield::sdf_internal {

/// Positions [m, world] of the copies of `population`, a <population>; all are upright, whatever
/// the model's pose. None, with a warning, if Gazebo draws them at random or places none. Throws
/// Error for numbers that are none, and for over 100,000 copies.
std::vector<Eigen::Vector3d> positions_of(Context& context, const tinyxml2::XMLElement& population);

}  // namespace tagfield::sdf_internal
