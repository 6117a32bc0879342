// SPDX-License-Identifier: Apache-2.0
/// @file
/// Top view of the world as polygons to draw.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "tagfield/world/scene.h"

namespace tagfield {

/// A closed polygon in the world's x, y [m].
using Polygon = std::vector<Eigen::Vector2d>;

/// Outline of one solid from above.
struct Silhouette {
  std::string name;    ///< Of the collision.
  double z_min = 0.0;  ///< Of the drawn part [m].
  double z_max = 0.0;
  std::vector<Polygon> rings;  ///< To be filled by the even-odd rule; holes are rings, too.
};

/// Top view of the world between two heights [m]: for each collision, the union of the projections
/// of its triangles, cut to the band and thickened by `margin` [m], so that a wall whose top is
/// above the band is still visible. Collisions outside the band and planes are left out. Sorted by
/// ascending z_max, so that later ones are drawn over earlier ones.
std::vector<Silhouette> top_view(const Scene& scene, double z_low, double z_high,
                                 double margin = 0.01);

/// Conversion to and from JSON text: [{"name", "z_min", "z_max", "rings": [[[x, y], …], …]}, …].
/// top_view_from_json() throws Error on anything else.
std::string top_view_to_json(const std::vector<Silhouette>& silhouettes);
std::vector<Silhouette> top_view_from_json(const std::string& text);

}  // namespace tagfield
