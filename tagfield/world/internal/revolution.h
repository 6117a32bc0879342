// SPDX-License-Identifier: Apache-2.0
/// @file
/// Solids of revolution.
#pragma once

#include <vector>

#include "tagfield/world/scene.h"

namespace tagfield {

/// A circle around z.
struct Ring {
  double radius = 0.0;  ///< [m]
  double z = 0.0;       ///< [m]
};

/// The solid within `rings` of kCircleEdges vertices each, from bottom to top, closed by fans to
/// the points at `bottom` and `top` on the axis [m].
TriangleMesh solid_of_revolution(double bottom, double top, const std::vector<Ring>& rings);

/// The rings of a sphere of `radius` [m] from pole to pole, with the same angular spacing as the
/// meridians.
std::vector<Ring> sphere_rings(double radius);

}  // namespace tagfield
