// SPDX-License-Identifier: Apache-2.0
/// @file
/// A part of the world from above as a drawing: the background of Figs. 9, 13 and 14.
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

/// The world between `axes.x.low` … `axes.y.high`, x to the right and y up, at the same scale.
struct MapView {
  std::string id;  ///< Of the figure, for IDs that must be unique on the page.
  Axes axes;
  double scale = 1.0;         ///< Units of the drawing per metre.
  std::vector<Extent> taken;  ///< Areas of the drawing that are occupied by labels and marks.
};

/// Position of a world point in the drawing.
Place on_map(const MapView& map, const Eigen::Vector3d& p_W);

/// A map of `content` with part of the geometry around it, with its top at `top`.
MapView make_map(const std::string& id, const Extent& content,
                 const std::vector<Silhouette>& geometry, double top);

/// Height of the whole figure, including axis labels.
double map_bottom(const MapView& map);

/// Draws grid, axes and geometry.
void draw_map(Svg& svg, const MapView& map, const std::vector<Silhouette>& geometry);

/// Draws only the geometry's outlines, as an overlay.
void draw_outlines(Svg& svg, const MapView& map, const std::vector<Silhouette>& geometry);

/// Draws the path of a body, thinned to visible steps.
void draw_path(Svg& svg, const MapView& map, const Trajectory& path, const std::string& css_class);
/// Draws small arrows along the path, and a ring with the word "start" at its beginning.
void draw_direction(Svg& svg, MapView& map, const Trajectory& path);

/// Keeps labels off a mark at `center`.
void take_place(MapView& map, const Place& center, double radius);
/// Draws a label next to a mark if there is room, else nothing.
void draw_label(Svg& svg, MapView& map, const Place& center, const std::string& text);

}  // namespace tagfield
