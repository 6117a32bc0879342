// SPDX-License-Identifier: Apache-2.0
/// @file
/// A world cut at one height.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/world/scene.h"

namespace tagfield {

/// A piece of a surface in the plane of the cut [m, world].
struct Segment {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
};

/// A square with sides along x and y.
struct Square {
  Eigen::Vector2d centre;  ///< [m, world]
  double half = 0.0;       ///< Half of a side [m].
};

/// Where the surfaces of all collisions pass the height `z_m`, as far as they are in `within`; a
/// plane is endless. Where two triangles share an edge, their segments share an end, to the bit.
/// Points at z_m itself count as above it, so each closed solid gives closed outlines.
/// Throws Error as world_mesh() does.
std::vector<Segment> cross_section(const Scene& scene, double z_m, const Square& within);

}  // namespace tagfield
