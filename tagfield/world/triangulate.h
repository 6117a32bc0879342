// SPDX-License-Identifier: Apache-2.0
/// @file
/// Triangulation of any shape.
#pragma once

#include "tagfield/world/scene.h"

namespace tagfield {

/// Number of edges that approximate a full circle.
inline constexpr int kCircleEdges = 32;

/// The surface of `shape` in its own frame C, normals outward: a box has 12 triangles, a plane 2
/// (its `size`), a cylinder and a sphere are inscribed polyhedra with kCircleEdges edges around.
TriangleMesh triangulate(const Shape& shape);

/// Number of triangles of triangulate(shape), without creating them.
std::size_t triangle_count(const Shape& shape);

}  // namespace tagfield
