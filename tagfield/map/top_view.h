// SPDX-License-Identifier: Apache-2.0
/// @file
/// The world from above, as polygons to draw.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "tagfield/world/scene.h"

namespace tagfield {

/// A closed polygon in the world's x, y [m].
using Polygon = std::vector<Eigen::Vector2d>;

/// The outline of one solid from above.
struct Silhouette {
  std::string name;    ///< Of the collision.
  double z_min = 0.0;  ///< Of what was drawn [m].
  double z_max = 0.0;
  std::vector<Polygon> rings;  ///< To be filled by the even-odd rule, so holes are rings too.
};

/// The part of the world between two heights [m] seen from above: for each collision the union of
/// its triangles' projections, cut to the band and thickened by `margin` [m] so that a wall whose
/// top lies above the band still shows. Collisions outside the band are left out, and so are
/// planes. Sorted by rising z_max, so that later ones are drawn over earlier ones.
std::vector<Silhouette> top_view(const Scene& scene, double z_low, double z_high,
                                 double margin = 0.01);

/// The two as JSON text: [{"name", "z_min", "z_max", "rings": [[[x, y], …], …]}, …]. `from` throws
/// Error on anything else.
std::string top_view_to_json(const std::vector<Silhouette>& silhouettes);
std::vector<Silhouette> top_view_from_json(const std::string& text);

}  // namespace tagfield
