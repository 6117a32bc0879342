// SPDX-License-Identifier: Apache-2.0
/// @file
/// Solids that have no shape of their own, as meshes: inscribed polyhedra with kCircleEdges around,
/// normals outward, as triangulate() has cylinders and spheres.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/world/scene.h"

namespace tagfield {

/// A cylinder along z of `radius` and `length` [m] with a half ball on each end, centred on the
/// origin.
TriangleMesh capsule_mesh(double radius, double length);

/// A cone along z with its base of `radius` at -length/2 and its tip at length/2 [m].
TriangleMesh cone_mesh(double radius, double length);

/// An ellipsoid with half axes `radii` [m], centred on the origin.
TriangleMesh ellipsoid_mesh(const Eigen::Vector3d& radii);

/// Corners [m] of a closed line in the plane, which may or may not come back to the first.
using Outline = std::vector<Eigen::Vector2d>;

/// The prism from z = 0 to `height` [m] over what `outlines` enclose; one inside another is a hole.
/// Outlines may touch but not cross themselves or one another. Without triangles where they enclose
/// nothing.
TriangleMesh prism_mesh(const std::vector<Outline>& outlines, double height);

}  // namespace tagfield
