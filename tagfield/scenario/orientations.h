// SPDX-License-Identifier: Apache-2.0
/// @file
/// How a tag may lie.
#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace tagfield {

/// Twelve rotations: the tag's face along each axis, and its wire upright and lying.
std::vector<Eigen::Quaterniond> orientations_along_axes();

}  // namespace tagfield
