// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/internal/map_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "tagfield/report/internal/ticks.h"

namespace tagfield {
namespace {

constexpr double kLeft = 48.0;
constexpr double kRight = 14.0;
constexpr double kTitleRoom = 30.0;
constexpr double kMaxHeight = 600.0;
constexpr double kMinAspect = 0.4;
constexpr double kSeen = 0.7;  ///< Shorter steps of an outline or a path are not visible.
constexpr double kArrowDistance = 120.0;

Extent extent_of(const std::vector<Silhouette>& geometry) {
  Extent box;
  for (const Silhouette& silhouette : geometry) {
    for (const Polygon& ring : silhouette.rings) {
      for (const Eigen::Vector2d& point : ring) box.extend(point);
    }
  }
  return box;
}

Extent grown(const Extent& box, double margin) {
  return {box.min() - Eigen::Vector2d::Constant(margin),
          box.max() + Eigen::Vector2d::Constant(margin)};
}

/// The content with a margin, and the geometry near it.
Extent shown_extent(const Extent& content, const std::vector<Silhouette>& geometry) {
  const double size = std::max(content.sizes().maxCoeff(), 1.0);
  const Extent least = grown(content, 0.05 * size);
  const Extent around = extent_of(geometry);
  if (around.isEmpty()) return least;
  const Extent near = grown(content, 0.35 * size).intersection(grown(around, 0.02 * size));
  return near.isEmpty() ? least : least.merged(near);
}

/// `box`, extended to a minimum aspect ratio.
Extent shaped(Extent box) {
  const Eigen::Vector2d size = box.sizes();
  const Eigen::Vector2d least(kMinAspect * size.y(), kMinAspect * size.x());
  const Eigen::Vector2d more = (0.5 * (least - size)).cwiseMax(0.0);
  return {box.min() - more, box.max() + more};
}

Scale map_scale(double low, double high, double from, double to, double units_per_metre) {
  const int count = std::clamp(static_cast<int>((high - low) * units_per_metre / 75.0), 2, 8);
  return {low, high, from, to, inner_ticks(low, high, count), false};
}

void append_ring(std::string& data, const MapView& map, const Polygon& ring) {
  Place last = Place::Constant(-1e9);
  char command = 'M';
  for (const Eigen::Vector2d& point : ring) {
    const Place place = place_in(map.axes, point.x(), point.y());
    if ((place - last).norm() < kSeen) continue;
    data += fmt::format("{}{},{}", command, compact(place.x()), compact(place.y()));
    command = 'L';
    last = place;
  }
  if (command == 'L') data += 'z';
}

void draw_silhouettes(Svg& svg, const MapView& map, const std::vector<Silhouette>& geometry,
                      const char* css_class) {
  for (const Silhouette& silhouette : geometry) {
    std::string data;
    for (const Polygon& ring : silhouette.rings) append_ring(data, map, ring);
    if (!data.empty()) add_path(svg, data, styled(css_class));
  }
}

std::vector<Place> thinned(const MapView& map, const Trajectory& path) {
  std::vector<Place> places;
  for (const StampedPose& pose : path) {
    const Place place = on_map(map, pose.X_WB.translation);
    if (places.empty() || (place - places.back()).norm() >= kSeen) places.push_back(place);
  }
  return places;
}

void draw_arrow(Svg& svg, const Place& tip, const Place& direction) {
  const Place along = direction.normalized();
  const Place across(-along.y(), along.x());
  const Place left = tip - 11.0 * along + 5.0 * across;
  const Place right = tip - 11.0 * along - 5.0 * across;
  add_path(svg,
           fmt::format("M{},{}L{},{}L{},{}z", compact(tip.x()), compact(tip.y()), compact(left.x()),
                       compact(left.y()), compact(right.x()), compact(right.y())),
           styled("ink"));
}

/// Keeps labels off a path.
void avoid_path(MapView& map, const std::vector<Place>& places) {
  Place last = Place::Constant(-1e9);
  for (const Place& place : places) {
    if ((place - last).norm() < 4.0) continue;
    take_place(map, place, 2.0);
    last = place;
  }
}

/// Bounding box of a label whose text begins, is centred, or ends at `place`.
Extent label_box(const Place& place, const std::string& text, Anchor anchor) {
  const double width = text_width(text);
  const double shift = anchor == Anchor::kStart ? 0.0 : anchor == Anchor::kEnd ? width : width / 2;
  const Place corner(place.x() - shift, place.y() - 12.0);
  return {corner, corner + Place(width, 15.0)};
}

bool is_free(const MapView& map, const Extent& box) {
  const Extent page(Place(map.axes.x.from, map.axes.y.to), Place(map.axes.x.to, map.axes.y.from));
  if (!page.contains(box)) return false;
  return std::none_of(map.taken.begin(), map.taken.end(),
                      [&](const Extent& other) { return other.intersects(box); });
}

}  // namespace

Place on_map(const MapView& map, const Eigen::Vector3d& p_W) {
  return place_in(map.axes, p_W.x(), p_W.y());
}

MapView make_map(const std::string& id, const Extent& content,
                 const std::vector<Silhouette>& geometry, double top) {
  const Extent box = shaped(shown_extent(content, geometry));
  const Eigen::Vector2d size = box.sizes();
  const double room = kDrawingWidth - kLeft - kRight;
  MapView map;
  map.id = id;
  map.scale = std::min(room / size.x(), kMaxHeight / size.y());
  const double left = kLeft + (room - map.scale * size.x()) / 2.0;
  const double ceiling = top + kTitleRoom;
  map.axes.x =
      map_scale(box.min().x(), box.max().x(), left, left + map.scale * size.x(), map.scale);
  map.axes.y =
      map_scale(box.min().y(), box.max().y(), ceiling + map.scale * size.y(), ceiling, map.scale);
  return map;
}

double map_bottom(const MapView& map) { return map.axes.y.from + 46.0; }

void draw_map(Svg& svg, const MapView& map, const std::vector<Silhouette>& geometry) {
  draw_axes(svg, map.axes, "x [m]", "y [m]");
  const Place corner(map.axes.x.from, map.axes.y.to);
  const Place size(map.axes.x.to - map.axes.x.from, map.axes.y.from - map.axes.y.to);
  begin_clip(svg, map.id + "-map", corner, size);
  draw_silhouettes(svg, map, geometry, "wall");
  end_clip(svg);
  add_rectangle(svg, corner, size, styled("frame"));
}

void draw_outlines(Svg& svg, const MapView& map, const std::vector<Silhouette>& geometry) {
  draw_silhouettes(svg, map, geometry, "outline");
}

void draw_path(Svg& svg, const MapView& map, const Trajectory& path, const std::string& css_class) {
  add_polyline(svg, thinned(map, path), styled(css_class));
}

void draw_direction(Svg& svg, MapView& map, const Trajectory& path) {
  const std::vector<Place> places = thinned(map, path);
  double travelled = 0.5 * kArrowDistance;
  for (std::size_t i = 1; i < places.size(); ++i) {
    travelled += (places[i] - places[i - 1]).norm();
    if (travelled < kArrowDistance) continue;
    travelled = 0.0;
    draw_arrow(svg, places[i], places[i] - places[i > 4 ? i - 4 : 0]);
  }
  if (places.empty()) return;
  avoid_path(map, places);
  add_circle(svg, places.front(), 6.0, styled("start"));
  take_place(map, places.front(), 6.0);
  draw_label(svg, map, places.front(), "start");
}

void take_place(MapView& map, const Place& center, double radius) {
  map.taken.emplace_back(center - Place::Constant(radius), center + Place::Constant(radius));
}

void draw_label(Svg& svg, MapView& map, const Place& center, const std::string& text) {
  struct Offset {
    Place shift;
    Anchor anchor;
  };
  const std::array<Offset, 4> offsets = {
      Offset{{12.0, 5.0}, Anchor::kStart}, Offset{{-12.0, 5.0}, Anchor::kEnd},
      Offset{{0.0, -13.0}, Anchor::kMiddle}, Offset{{0.0, 24.0}, Anchor::kMiddle}};
  for (const Offset& offset : offsets) {
    const Place place = center + offset.shift;
    const Extent box = label_box(place, text, offset.anchor);
    if (!is_free(map, box)) continue;
    map.taken.push_back(box);
    add_rimmed_text(svg, place, text, offset.anchor);
    return;
  }
}

}  // namespace tagfield
