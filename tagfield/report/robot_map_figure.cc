// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "tagfield/report/figures.h"
#include "tagfield/report/internal/figure_data.h"
#include "tagfield/report/internal/map_outline.h"
#include "tagfield/report/internal/map_view.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxCells = 1200;  ///< Along x or y; smaller cells are not visible.

/// Extent of the known part of the map, and of the paths on it.
Extent content_of(const OccupancyGrid& grid, const MappingWay& way) {
  Extent extent;
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * grid.resolution_m);
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      if (grid.at(x, y) < 0) continue;
      extent.extend(grid.centre_of(x, y) - half);
      extent.extend(grid.centre_of(x, y) + half);
    }
  }
  for (const Trajectory* path : {&way.believed, &way.truth}) {
    for (const StampedPose& pose : *path) extent.extend(pose.X_WB.translation.head<2>());
  }
  return extent;
}

/// Transform from cells, y upwards, to the drawing.
std::string cells_to_drawing(const MapView& map, const OccupancyGrid& grid) {
  const Place origin = place_in(map.axes, grid.origin.x(), grid.origin.y());
  const double size = map.scale * grid.resolution_m;
  return fmt::format("transform=\"matrix({0:.6g} 0 0 -{0:.6g} {1:.6g} {2:.6g})\"", size, origin.x(),
                     origin.y());
}

void draw_cells(Svg& svg, const MapView& map, const OccupancyGrid& grid) {
  const Place corner(map.axes.x.from, map.axes.y.to);
  const Place size(map.axes.x.to - map.axes.x.from, map.axes.y.from - map.axes.y.to);
  begin_clip(svg, map.id + "-cells", corner, size);
  add_rectangle(svg, corner, size, styled("map-unknown"));
  begin_group(svg, cells_to_drawing(map, grid));
  add_path(svg, cell_outline(grid, is_free), styled("map-free"));
  add_path(svg, cell_outline(grid, is_occupied), styled("map-occupied"));
  end_group(svg);
  end_clip(svg);
  add_rectangle(svg, corner, size, styled("frame"));
}

void draw_way(Svg& svg, MapView& map, const MappingWay& way) {
  begin_group(svg, "class=\"on-map\"");
  if (!way.truth.empty()) draw_path(svg, map, way.truth, "mapping-true");
  if (!way.believed.empty()) draw_path(svg, map, way.believed, "mapping");
  if (!way.believed.empty()) draw_direction(svg, map, way.believed);
  end_group(svg);
}

std::vector<LegendEntry> legend_of(const MappingWay& way) {
  std::vector<LegendEntry> entries;
  if (!way.believed.empty()) {
    entries.push_back({Symbol::kLine, "mapping", "path while mapping, as believed"});
  }
  if (!way.truth.empty()) entries.push_back({Symbol::kLine, "mapping-true", "true path"});
  return entries;
}

/// Mean horizontal distance between the two paths [m].
std::optional<double> mean_distance(const MappingWay& way) {
  std::vector<double> distances;
  for (const StampedPose& pose : way.believed) {
    const auto truth = pose_at(way.truth, pose.stamp);
    if (truth) {
      distances.push_back((pose.X_WB.translation - truth->translation).head<2>().norm());
    }
  }
  const auto numbers = statistics(distances);
  return numbers ? std::optional(numbers->mean) : std::nullopt;
}

std::string caption_of(const RunFiles& run, std::size_t step) {
  std::string text = fmt::format(
      "What the laser {}: white is free, dark is occupied, grey is unknown; cells of {}.",
      run.mapping_way.believed.empty() ? "can expect" : "saw",
      spoken_length(run.map->resolution_m));
  if (const auto distance = mean_distance(run.mapping_way)) {
    text +=
        fmt::format(" Believed and true path are {} apart on average.", spoken_length(*distance));
  }
  if (run.summary.seeds.size() > 1) {
    text += fmt::format(" Shown is the first of {} seeds.", run.summary.seeds.size());
  }
  if (step > 1) text += fmt::format(" {0}×{0} cells are drawn as one.", step);
  return text;
}

}  // namespace

Figure robot_map_figure(const RunFiles& run) {
  Figure figure{"fig06_robot_map", "Fig. 6", "Map made by the robot", "", {}, ""};
  const Extent content = run.map ? content_of(*run.map, run.mapping_way) : Extent();
  if (content.isEmpty()) {
    figure.missing = run.map ? "the map knows nothing." : "there is no map.yaml.";
    return figure;
  }
  if (run.mapping_way.believed.empty()) figure.title = "Map given to the robot";
  const auto longer = static_cast<std::size_t>(std::max(run.map->width, run.map->height));
  const std::size_t step = thinning(longer, kMaxCells);
  const double legend = draw_legend(figure.svg, legend_of(run.mapping_way));
  MapView map = make_map(figure.name, content, {}, legend);
  figure.svg.height = map_bottom(map);
  draw_map(figure.svg, map, {});
  draw_cells(figure.svg, map, coarsened(*run.map, static_cast<int>(step)));
  draw_way(figure.svg, map, run.mapping_way);
  figure.caption = caption_of(run, step);
  figure.data = "what,time_s,x_m,y_m\n";
  for (const auto& [name, path] : {std::pair("believed", &run.mapping_way.believed),
                                   std::pair("true", &run.mapping_way.truth)}) {
    for (std::size_t i = 0; i < path->size(); i += thinning(path->size(), kMaxMarks)) {
      const StampedPose& pose = (*path)[i];
      add_data(figure.data, name, to_seconds(pose.stamp), pose.X_WB.translation.x(),
               pose.X_WB.translation.y());
    }
  }
  return figure;
}

}  // namespace tagfield
