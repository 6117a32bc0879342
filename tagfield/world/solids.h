// SPDX-License-Identifier: Apache-2.0
/// @file
/// Meshes of solids without a shape type of their own: inscribed polyhedra with kCircleEdges edges
/// around, normals outward, like triangulate()'s cylinders and spheres.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/world/scene.h"

namespace tagfield {

/// A capsule: a cylinder along z of `radius` and `length` [m] with a hemisphere at each end,
/// centred on the origin.
TriangleMesh capsule_mesh(double radius, double length);

/// A cone along z with its base of `radius` at -length/2 and its tip at length/2 [m].
TriangleMesh cone_mesh(double radius, double length);

/// An ellipsoid with half axes `radii` [m], centred on the origin.
TriangleMesh ellipsoid_mesh(const Eigen::Vector3d& radii);

/// Vertices [m] of a closed polygon in the plane; the first may be repeated at the end.
using Outline = std::vector<Eigen::Vector2d>;

/// The prism from z = 0 to `height` [m] over the area enclosed by `outlines`; an outline inside
/// another is a hole. Outlines may touch but not cross themselves or each other. No triangles if
/// they enclose no area.
TriangleMesh prism_mesh(const std::vector<Outline>& outlines, double height);

}  // namespace tagfield
