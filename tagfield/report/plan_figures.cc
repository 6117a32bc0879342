// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tagfield/report/axes.h"
#include "tagfield/report/internal/color_bands.h"
#include "tagfield/report/internal/figure_data.h"
#include "tagfield/report/internal/map_view.h"
#include "tagfield/report/plan_page.h"
#include "tagfield/report/text.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxMaps = 4;
constexpr std::size_t kMaxCircles = 6000;

/// Positions between two heights.
struct Level {
  double low_m = 0.0;
  double high_m = 0.0;
  std::vector<std::size_t> places;
};

std::vector<Level> levels_of(const AntennaPlan& plan) {
  std::vector<double> heights;
  for (const PlannedPlace& place : plan.places) heights.push_back(place.p_W.z());
  std::sort(heights.begin(), heights.end());
  std::vector<Level> levels;
  for (const double z : heights) {
    if (levels.empty() || z > levels.back().high_m + 0.05) levels.push_back({z, z, {}});
    levels.back().high_m = z;
  }
  if (levels.size() > kMaxMaps) {
    const double low = heights.front();
    const double step = (heights.back() - low) / static_cast<double>(kMaxMaps);
    levels.clear();
    for (std::size_t i = 0; i < kMaxMaps; ++i) {
      const auto number = static_cast<double>(i);
      levels.push_back({low + number * step, low + (number + 1.0) * step, {}});
    }
  }
  for (std::size_t i = 0; i < plan.places.size(); ++i) {
    const double z = plan.places[i].p_W.z();
    auto level = std::find_if(levels.begin(), levels.end(),
                              [&](const Level& one) { return z <= one.high_m + 1e-9; });
    (level == levels.end() ? levels.back() : *level).places.push_back(i);
  }
  return levels;
}

Extent extent_of_plan(const AntennaPlan& plan) {
  Extent extent;
  for (const PlannedPlace& place : plan.places) extent.extend(place.p_W.head<2>());
  for (const PlannedLayout& layout : plan.layouts) {
    for (const PlannedAntenna& antenna : layout.antennas) extent.extend(antenna.p_W.head<2>());
  }
  const Eigen::Vector2d rim = Eigen::Vector2d::Constant(0.5);
  return {extent.min() - rim, extent.max() + rim};
}

/// The error at a position, if the aim is a position error.
std::string error_text(const PlannedLayout& layout, std::size_t place) {
  if (layout.errors_m.empty()) return "";
  return std::isfinite(layout.errors_m[place])
             ? fmt::format(", error {:.2f} m at best", layout.errors_m[place])
             : ", read by too few antennas";
}

void draw_position(Svg& svg, const MapView& map, const AntennaPlan& plan, std::size_t place,
                   double radius) {
  const ColorBands bands = probability_bands();
  const double p = plan.layouts[plan.chosen].places[place];
  const std::string& color = bands.colors[band_of(bands, p)];
  Look look = filled(color.empty() ? "#8a949e" : color, 1.0);
  look.attributes += fmt::format(" class=\"place\" data-place=\"{}\"", place);
  add_circle(svg, on_map(map, plan.places[place].p_W), radius, look,
             fmt::format("{}: {:.0f} %{}", clean_text(plan.places[place].group), 100.0 * p,
                         error_text(plan.layouts[plan.chosen], place)));
}

/// The class of a reader's antennas.
std::string class_of_reader(std::size_t number) { return fmt::format("reader{}", number); }

/// The look of a part of an antenna at `at`, where it stays when the figure is zoomed.
Look antenna_look(std::size_t reader, double opacity, const Place& at) {
  Look look = filled(color_of_kind(reader), opacity);
  look.attributes += fmt::format(" class=\"{}\" data-at=\"{} {}\"", class_of_reader(reader),
                                 compact(at.x()), compact(at.y()));
  return look;
}

/// A wedge that opens in the direction of the boresight, or a ring if that is vertical.
void draw_planned_antenna(Svg& svg, const MapView& map, const PlannedAntenna& antenna,
                          std::size_t reader) {
  const Place at = on_map(map, antenna.p_W);
  const Eigen::Vector2d level = antenna.boresight_W.head<2>();
  const std::string said = fmt::format("{} ({}), {:g} dBm", clean_text(antenna.name),
                                       clean_text(antenna.reader), antenna.power_dbm);
  if (level.norm() > 0.3) {
    const Place along(level.x() / level.norm(), -level.y() / level.norm());
    const Place across(-along.y(), along.x());
    const Place tip = at + 17.0 * along;
    add_path(svg,
             fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}Z", at.x(), at.y(),
                         tip.x() + 8.0 * across.x(), tip.y() + 8.0 * across.y(),
                         tip.x() - 8.0 * across.x(), tip.y() - 8.0 * across.y()),
             antenna_look(reader, 0.45, at), said);
  } else {
    add_circle(svg, at, 11.0, antenna_look(reader, 0.35, at), said);
  }
  Look body = antenna_look(reader, 1.0, at);
  body.attributes += " stroke=\"#ffffff\" stroke-width=\"1.5\"";
  add_rectangle(svg, at - Place(5, 5), {10, 10}, body, said);
}

std::vector<std::string> readers_of_all(const AntennaPlan& plan) {
  std::vector<std::string> readers;
  for (const PlannedLayout& layout : plan.layouts) {
    for (const PlannedAntenna& antenna : layout.antennas) {
      if (std::find(readers.begin(), readers.end(), antenna.reader) == readers.end()) {
        readers.push_back(antenna.reader);
      }
    }
  }
  return readers;
}

/// One entry of the legend, at most as wide as the drawing; `draw` gets the place of its symbol.
template <typename Draw>
void add_key(Svg& svg, Place& at, const std::string& key, const std::string& text,
             const Draw& draw) {
  const double width = 28.0 + text_width(text);
  if (at.x() > 2.0 && at.x() + width > kDrawingWidth) at = {2.0, at.y() + 22.0};
  begin_group(svg, fmt::format("class=\"key\" data-key=\"{}\"", key));
  draw(Place(at.x() + 9.0, at.y()));
  add_text(svg, at + Place(22.0, 5.0), text, Anchor::kStart);
  end_group(svg);
  at.x() += width + 18.0;
}

/// Positions, and the antennas of each of a few readers. Returns the height.
double draw_plan_legend(Svg& svg, const std::vector<std::string>& readers) {
  Place at(2.0, 12.0);
  add_key(svg, at, "place", "position of tags",
          [&](const Place& place) { add_circle(svg, place, 6.0, filled("#8a949e", 1.0)); });
  for (std::size_t i = 0; readers.size() <= kPlainKinds && i < readers.size(); ++i) {
    add_key(svg, at, class_of_reader(i), "antenna of " + shortened(readers[i], 18),
            [&](const Place& place) {
              add_rectangle(svg, place - Place(6, 6), {12, 12}, filled(color_of_kind(i), 1.0));
            });
  }
  return at.y() + 16.0;
}

Figure level_figure(const AntennaPlan& plan, const Level& level, std::size_t number,
                    const std::vector<Silhouette>& top_view) {
  Figure figure;
  figure.name = fmt::format("plan_level_{}", number + 1);
  figure.title =
      level.high_m - level.low_m < 0.005
          ? fmt::format("Tags at {:.2f} m", level.low_m + 0.0)
          : fmt::format("Tags from {:.2f} to {:.2f} m", level.low_m + 0.0, level.high_m + 0.0);
  const std::vector<std::string> readers = readers_of_all(plan);
  MapView map =
      make_map(figure.name, extent_of_plan(plan), {}, draw_plan_legend(figure.svg, readers));
  figure.svg.height = map_bottom(map);
  draw_axes(figure.svg, map.axes, "x [m]", "y [m]");
  begin_clip(figure.svg, map.id + "-map", {map.axes.x.from, map.axes.y.to},
             {map.axes.x.to - map.axes.x.from, map.axes.y.from - map.axes.y.to});
  const std::size_t step = thinning(level.places.size(), kMaxCircles / kMaxMaps);
  const double area = (map.axes.x.to - map.axes.x.from) * (map.axes.y.from - map.axes.y.to);
  const double crowd = static_cast<double>(std::max<std::size_t>(level.places.size() / step, 1));
  const double radius = std::clamp(0.32 * std::sqrt(area / crowd), 2.0, 7.0);
  figure.data = "group,x_m,y_m,z_m,share\n";
  for (std::size_t i = 0; i < level.places.size(); i += step) {
    const std::size_t index = level.places[i];
    draw_position(figure.svg, map, plan, index, radius);
    const PlannedPlace& place = plan.places[index];
    add_data(figure.data, place.group, place.p_W.x(), place.p_W.y(), place.p_W.z(),
             plan.layouts[plan.chosen].places[index]);
  }
  draw_outlines(figure.svg, map, top_view);
  for (std::size_t i = 0; i < plan.layouts.size(); ++i) {
    begin_group(figure.svg, fmt::format("class=\"layout\" data-layout=\"{}\"{}", i,
                                        i == plan.chosen ? "" : " style=\"display:none\""));
    for (const PlannedAntenna& antenna : plan.layouts[i].antennas) {
      const auto reader = std::find(readers.begin(), readers.end(), antenna.reader);
      draw_planned_antenna(figure.svg, map, antenna,
                           static_cast<std::size_t>(reader - readers.begin()));
    }
    end_group(figure.svg);
  }
  end_clip(figure.svg);
  add_rectangle(figure.svg, {map.axes.x.from, map.axes.y.to},
                {map.axes.x.to - map.axes.x.from, map.axes.y.from - map.axes.y.to},
                styled("frame"));
  figure.caption = fmt::format(
      "{} from above; antennas as squares, one colour per reader, with their direction (a disc: "
      "down or up).",
      counted(level.places.size(), "position"));
  if (step > 1) figure.caption += fmt::format(" One in {} is drawn.", step);
  return figure;
}

std::vector<LegendEntry> curve_legend(bool has_bounds) {
  std::vector<LegendEntry> legend = {{Symbol::kLine, "curve", "expected"},
                                     {Symbol::kLine, "whisker", "95 % of runs"}};
  if (has_bounds) legend.push_back({Symbol::kLine, "rule", "bound"});
  return legend;
}

Figure curve_figure(const AntennaPlan& plan) {
  Figure figure{"plan_curve", "", "What each antenna adds", "", {}, ""};
  const auto most = static_cast<double>(plan.layouts.back().antennas.size());
  const auto tags = static_cast<double>(std::max<std::size_t>(plan.tags, 1));
  Axes axes{tight_scale(0.0, std::max(most, 1.0) + 0.5, std::clamp(static_cast<int>(most), 1, 8)),
            tight_scale(0.0, 100.0, 5)};
  axes.x.from = 52.0;
  axes.x.to = kDrawingWidth - 24.0;
  // For a position error the bound of the maximized score does not bound the number of tags.
  const bool has_bounds = plan.aim.kind != PlannedAim::Kind::kPosition;
  axes.y.to = draw_legend(figure.svg, curve_legend(has_bounds)) + 34.0;
  axes.y.from = axes.y.to + 266.0;
  figure.svg.height = axes.y.from + 48.0;
  draw_axes(figure.svg, axes, "antennas", fmt::format("tags {} [%]", words_for(plan.aim)));
  using Kind = PlannedAim::Kind;
  const double most_likely = plan.aim.kind == Kind::kReadProbability ? plan.aim.value : 1.0;
  std::vector<Place> means;
  std::vector<Place> bounds;
  for (const PlannedLayout& layout : plan.layouts) {
    const auto count = static_cast<double>(layout.antennas.size());
    const double x = place_on(axes.x, count);
    add_line(figure.svg, {x, place_on(axes.y, 100.0 * layout.read.low / tags)},
             {x, place_on(axes.y, 100.0 * layout.read.high / tags)}, styled("whisker"));
    means.push_back(place_in(axes, count, 100.0 * layout.read.mean / tags));
    bounds.push_back(place_in(axes, count, 100.0 * layout.bound * most_likely));
  }
  Look dashed = styled("rule");
  dashed.attributes += " fill=\"none\"";
  if (has_bounds) add_polyline(figure.svg, bounds, dashed);
  add_polyline(figure.svg, means, styled("curve"));
  for (std::size_t i = 0; i < means.size(); ++i) {
    const PlannedLayout& layout = plan.layouts[i];
    add_circle(figure.svg, means[i], i == plan.chosen ? 6.5 : 3.5, styled("ink"),
               fmt::format("{} antennas: {:.1f} of {} tags, cost {:g}", layout.antennas.size(),
                           layout.read.mean, plan.tags, layout.cost));
  }
  figure.caption = fmt::format(
      "Tags {} in the time, with the range of 95 % of runs.{} The large "
      "dot is the chosen one.",
      words_for(plan.aim),
      has_bounds ? " Dashed: no layout of as many antennas within the "
                   "limits has more, before contention for slots."
                 : "");
  figure.data = plan_layouts_to_csv(plan);
  return figure;
}

}  // namespace

std::vector<Figure> plan_figures(const AntennaPlan& plan, const std::vector<Silhouette>& top_view) {
  std::vector<Figure> figures;
  const std::vector<Level> levels = levels_of(plan);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    if (!levels[i].places.empty()) figures.push_back(level_figure(plan, levels[i], i, top_view));
  }
  figures.push_back(curve_figure(plan));
  return figures;
}

}  // namespace tagfield
