// SPDX-License-Identifier: Apache-2.0
/// @file
/// A collision's triangles in the world frame.
#pragma once

#include "tagfield/world/scene.h"

namespace tagfield {

/// The triangles of triangulate() with their vertices in W. Throws Error, naming the collision, if
/// a vertex is not finite or over 1e9 m along an axis from the world's origin, or if a triangle's
/// vertex index is out of range.
TriangleMesh world_mesh(const Collision& collision);

}  // namespace tagfield
