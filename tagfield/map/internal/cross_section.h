// SPDX-License-Identifier: Apache-2.0
/// @file
/// Cross-section of a world at one height.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/world/scene.h"

namespace tagfield {

/// Section of a surface in the cutting plane [m, world].
struct Segment {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
};

/// A square with sides along x and y.
struct Square {
  Eigen::Vector2d centre;  ///< [m, world]
  double half = 0.0;       ///< Half of a side [m].
};

/// Intersections of the surfaces of all collisions with the height `z_m`, clipped to `within`;
/// planes are infinite. If two triangles share an edge, their segments share a bit-identical end
/// point. Points at z_m itself count as above it, so that closed solids give closed outlines.
/// Throws Error as world_mesh() does.
std::vector<Segment> cross_section(const Scene& scene, double z_m, const Square& within);

}  // namespace tagfield
