// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where a solid's surface is bent or ends, in pieces as its triangles have them.
#pragma once

#include <array>
#include <vector>

#include "tagfield/propagation/diffraction.h"
#include "tagfield/propagation/internal/welded_mesh.h"

namespace tagfield {

/// Straight edges of a mesh, as diffracting_edges() describes them, but neither covered ones nor
/// short ones left out, and `solid` and `mirrors` not set. In the order of their ends' coordinates.
std::vector<DiffractingEdge> creases(const WeldedMesh& mesh);

}  // namespace tagfield
