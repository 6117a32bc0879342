// SPDX-License-Identifier: Apache-2.0
/// @file
/// A collision's triangles where they stand.
#pragma once

#include "tagfield/world/scene.h"

namespace tagfield {

/// The triangles of triangulate() with their vertices in W. Throws Error, naming the collision, if
/// a vertex is not finite or further than 1e9 m along an axis from the world's origin, or if a
/// triangle names a vertex that is not there.
TriangleMesh world_mesh(const Collision& collision);

}  // namespace tagfield
