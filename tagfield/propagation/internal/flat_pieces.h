// SPDX-License-Identifier: Apache-2.0
/// @file
/// Facets of one solid.
#pragma once

#include <vector>

#include "tagfield/propagation/internal/welded_mesh.h"
#include "tagfield/propagation/radio_scene.h"

namespace tagfield {

/// Facets made of triangles that are flat to 0.1 mm and joined by edges, using only triangles for
/// which `mirrors` (by triangle of `mesh`) is nonzero. Their `solid` is left 0; `shell` is the
/// piece's index.
std::vector<Facet> flat_pieces(const WeldedMesh& mesh, const std::vector<Edge>& edges,
                               const Pieces& pieces, const std::vector<char>& mirrors);

/// The unbounded facet of a plane.
Facet endless_facet(const Eigen::Vector3d& normal_W, double offset_m);

}  // namespace tagfield
