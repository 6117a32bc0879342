// SPDX-License-Identifier: Apache-2.0
/// @file
/// Creases and borders of a solid's surface.
#pragma once

#include <array>
#include <vector>

#include "tagfield/propagation/diffraction.h"
#include "tagfield/propagation/internal/welded_mesh.h"

namespace tagfield {

/// Straight edges of a mesh as described at diffracting_edges(), but including covered and short
/// ones, and without merging those of plates. `solid` and `mirrors` are not set. Sorted by the
/// coordinates of their ends.
std::vector<DiffractingEdge> creases(const WeldedMesh& mesh);

}  // namespace tagfield
