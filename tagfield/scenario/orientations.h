// SPDX-License-Identifier: Apache-2.0
/// @file
/// Possible orientations of a tag.
#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace tagfield {

/// Twelve rotations: the tag's normal along each direction of each axis, each with two orientations
/// of its dipole.
std::vector<Eigen::Quaterniond> orientations_along_axes();

}  // namespace tagfield
