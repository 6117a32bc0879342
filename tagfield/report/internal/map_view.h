// SPDX-License-Identifier: Apache-2.0
/// @file
/// A part of the world from above as a drawing: the ground of Figs. 9, 13 and 14.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/map/top_view.h"
#include "tagfield/poses/trajectory.h"
#include "tagfield/report/axes.h"

namespace tagfield {

using Extent = Eigen::AlignedBox2d;  ///< In the world's x, y [m].

/// The world between `axes.x.low` … `axes.y.high`, x to the right and y up, equally scaled.
struct MapView {
  std::string id;  ///< Of the figure, for what must be unique on the page.
  Axes axes;
  double scale = 1.0;         ///< Units of the drawing per metre.
  std::vector<Extent> taken;  ///< In the drawing, by labels and marks.
};

/// Place of a point in the world.
Place on_map(const MapView& map, const Eigen::Vector3d& p_W);

/// A map of `content` and as much of the geometry around it as helps, its top at `top`.
MapView make_map(const std::string& id, const Extent& content,
                 const std::vector<Silhouette>& geometry, double top);

/// Height of the whole figure, axis labels included.
double map_bottom(const MapView& map);

/// Draws grid, axes and geometry.
void draw_map(Svg& svg, const MapView& map, const std::vector<Silhouette>& geometry);

/// Draws the geometry's outlines alone, to be seen over what lies under them.
void draw_outlines(Svg& svg, const MapView& map, const std::vector<Silhouette>& geometry);

/// Draws the way of a body, thinned to what can be seen.
void draw_path(Svg& svg, const MapView& map, const Trajectory& path, const std::string& css_class);
/// Small arrows along the way, and a ring with the word "start" at its beginning.
void draw_direction(Svg& svg, MapView& map, const Trajectory& path);

/// Keeps labels off a mark at `center`.
void take_place(MapView& map, const Place& center, double radius);
/// Writes a label beside a mark, where there is room; nothing where there is none.
void draw_label(Svg& svg, MapView& map, const Place& center, const std::string& text);

}  // namespace tagfield
