// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "tagfield/report/axes.h"
#include "tagfield/report/comparison_page.h"
#include "tagfield/report/internal/figure_data.h"
#include "tagfield/report/internal/map_view.h"

namespace tagfield {
namespace {

constexpr std::array<const char*, 2> kDots = {"dot0", "dot1"};
constexpr double kNames = 122.0;
constexpr double kTop = 34.0;

/// A tag with an error in both runs.
struct ErrorPair {
  std::string tag;
  std::array<double, 2> errors_mm;
};

std::vector<ErrorPair> pairs_of(const RunComparison& comparison) {
  std::vector<ErrorPair> pairs;
  for (const ComparedTag& tag : comparison.tags) {
    const auto& [first, second] = tag.runs;
    if (!first.error_m || !second.error_m) continue;
    pairs.push_back({tag.tag, {1e3 * *first.error_m, 1e3 * *second.error_m}});
  }
  return pairs;
}

std::vector<LegendEntry> both_runs(const RunComparison& comparison) {
  return {{Symbol::kDot, kDots[0], shortened(comparison.runs[0].name, 30)},
          {Symbol::kDot, kDots[1], shortened(comparison.runs[1].name, 30)}};
}

std::string described(const RunComparison& comparison, const ErrorPair& pair, std::size_t run) {
  return fmt::format("{}: {} in {}", clean_text(pair.tag),
                     spoken_length(1e-3 * pair.errors_mm[run]),
                     clean_text(comparison.runs[run].name));
}

/// Draws one row per tag: both errors, and a line between them.
void draw_pairs(Figure& figure, const RunComparison& comparison,
                const std::vector<ErrorPair>& pairs) {
  double most = 0.0;
  for (const ErrorPair& pair : pairs) {
    most = std::max({most, pair.errors_mm[0], pair.errors_mm[1]});
  }
  const double legend = draw_legend(figure.svg, both_runs(comparison));
  Axes axes;
  axes.x = round_scale(0.0, std::max(most, 1e-6), 5);
  axes.x.from = kNames;
  axes.x.to = kDrawingWidth - 24.0;
  axes.y.to = legend + kTop;
  const double height = row_height(pairs.size());
  axes.y.from = axes.y.to + height * static_cast<double>(pairs.size()) + 4.0;
  figure.svg.height = axes.y.from + 48.0;
  draw_x_axis(figure.svg, axes, "error [mm]");
  for (std::size_t row = 0; row < pairs.size(); ++row) {
    const double y = axes.y.to + height * (static_cast<double>(row) + 0.5) + 2.0;
    add_text(figure.svg, {axes.x.from - 10.0, y + 5.0}, shortened(pairs[row].tag, 10),
             Anchor::kEnd);
    const std::array<Place, 2> ends = {Place(place_on(axes.x, pairs[row].errors_mm[0]), y),
                                       Place(place_on(axes.x, pairs[row].errors_mm[1]), y)};
    add_line(figure.svg, ends[0], ends[1], styled("whisker"));
    for (std::size_t run = 0; run < 2; ++run) {
      add_circle(figure.svg, ends[run], 5.0, styled(kDots[run]),
                 described(comparison, pairs[row], run));
    }
  }
}

/// For many tags, draws one dot each: the error in the first run along x, in the second along y.
void draw_cloud(Figure& figure, const RunComparison& comparison,
                const std::vector<ErrorPair>& pairs) {
  double least = 1e9;
  double most = 0.0;
  for (const ErrorPair& pair : pairs) {
    for (const double error : pair.errors_mm) {
      most = std::max(most, error);
      if (error > 0.0) least = std::min(least, error);
    }
  }
  least = std::min(least, std::max(most, 1e-3) / 10.0);
  Axes axes{logarithmic_scale(least, std::max(most, 1e-2)),
            logarithmic_scale(least, std::max(most, 1e-2))};
  axes.x.from = 62.0;
  axes.x.to = kDrawingWidth - 24.0;
  axes.y.to = kTop;
  axes.y.from = kTop + axes.x.to - axes.x.from;
  figure.svg.height = axes.y.from + 48.0;
  draw_axes(figure.svg, axes, "error in " + shortened(comparison.runs[0].name, 30) + " [mm]",
            "error in " + shortened(comparison.runs[1].name, 30) + " [mm]");
  add_line(figure.svg, {axes.x.from, axes.y.from}, {axes.x.to, axes.y.to}, styled("rule"));
  const std::size_t step = thinning(pairs.size(), kMaxMarks);
  for (std::size_t i = 0; i < pairs.size(); i += step) {
    const ErrorPair& pair = pairs[i];
    add_circle(
        figure.svg, place_in(axes, pair.errors_mm[0], pair.errors_mm[1]), 3.0,
        styled(pair.errors_mm[1] > pair.errors_mm[0] ? kDots[0] : kDots[1]),
        fmt::format("{}: {} and {}", clean_text(pair.tag), spoken_length(1e-3 * pair.errors_mm[0]),
                    spoken_length(1e-3 * pair.errors_mm[1])));
  }
}

Figure errors_figure(const RunComparison& comparison) {
  Figure figure{"compared_errors", "", "Errors in both runs", "", {}, ""};
  const std::vector<ErrorPair> pairs = pairs_of(comparison);
  if (pairs.empty()) {
    figure.missing = "no tag has a known error in both runs.";
    return figure;
  }
  if (pairs.size() <= kMaxRows) {
    draw_pairs(figure, comparison, pairs);
    figure.caption = "The error of each tag that both runs located, one row per tag.";
  } else {
    draw_cloud(figure, comparison, pairs);
    figure.caption =
        "A dot for each tag that both runs located, in the colour of the run with the smaller "
        "error; both axes are logarithmic. Below the line the second run is better, above it the "
        "first.";
  }
  figure.data = "tag,first_error_mm,second_error_mm\n";
  for (const ErrorPair& pair : pairs) {
    add_data(figure.data, pair.tag, pair.errors_mm[0], pair.errors_mm[1]);
  }
  return figure;
}

Extent extent_of(const RunComparison& comparison) {
  Extent certain;
  for (const ComparedTag& tag : comparison.tags) {
    if (tag.truth_m) certain.extend(tag.truth_m->head<2>());
  }
  Extent extent = certain;
  const double reach = certain.isEmpty() ? 1e9 : std::max(certain.sizes().maxCoeff(), 8.0);
  for (const ComparedTag& tag : comparison.tags) {
    for (const ComparedOutcome& run : tag.runs) {
      if (!run.position_m) continue;
      const Eigen::Vector2d place = run.position_m->head<2>();
      if (certain.isEmpty() || certain.exteriorDistance(place) < reach) extent.extend(place);
    }
  }
  return extent;
}

void draw_compared_tag(Svg& svg, const MapView& map, const RunComparison& comparison,
                       const ComparedTag& tag) {
  if (tag.truth_m) {
    add_diamond(svg, on_map(map, *tag.truth_m), 10.0, styled("truth"),
                clean_text(tag.tag) + ", true position");
  }
  const auto& [first, second] = tag.runs;
  if (first.position_m && second.position_m) {
    add_line(svg, on_map(map, *first.position_m), on_map(map, *second.position_m),
             styled("whisker"));
  }
  for (std::size_t run = 0; run < 2; ++run) {
    const ComparedOutcome& outcome = tag.runs[run];
    if (!outcome.position_m) continue;
    add_circle(svg, on_map(map, *outcome.position_m), run == 0 ? 5.5 : 3.5, styled(kDots[run]),
               fmt::format("{} in {}{}", clean_text(tag.tag), clean_text(comparison.runs[run].name),
                           outcome.error_m ? ": off by " + spoken_length(*outcome.error_m) : ""));
  }
}

Figure places_figure(const RunComparison& comparison, const std::vector<Silhouette>& geometry) {
  Figure figure{"compared_places", "", "Estimates of both runs", "", {}, ""};
  const bool any = std::any_of(comparison.tags.begin(), comparison.tags.end(), [](const auto& tag) {
    return tag.runs[0].position_m || tag.runs[1].position_m;
  });
  const Extent extent = extent_of(comparison);
  if (!any || extent.isEmpty()) {
    figure.missing = "no tag was located in either run.";
    return figure;
  }
  std::vector<LegendEntry> entries = both_runs(comparison);
  entries.push_back({Symbol::kDiamond, "truth", "tag, true"});
  const double legend = draw_legend(figure.svg, entries);
  MapView map = make_map(figure.name, extent, geometry, legend);
  figure.svg.height = map_bottom(map);
  draw_map(figure.svg, map, geometry);
  begin_clip(figure.svg, map.id + "-tags", {map.axes.x.from, map.axes.y.to},
             {map.axes.x.to - map.axes.x.from, map.axes.y.from - map.axes.y.to});
  const std::size_t step = thinning(comparison.tags.size(), kMaxMarks / 3);
  for (std::size_t i = 0; i < comparison.tags.size(); i += step) {
    draw_compared_tag(figure.svg, map, comparison, comparison.tags[i]);
  }
  end_clip(figure.svg);
  for (const ComparedTag& tag : comparison.tags) {
    const auto place = tag.truth_m ? tag.truth_m : tag.runs[0].position_m;
    if (place && comparison.tags.size() <= kMaxRows) {
      take_place(map, on_map(map, *place), 7.0);
      draw_label(figure.svg, map, on_map(map, *place), shortened(tag.tag, 12));
    }
  }
  figure.caption =
      "From above. Lines join the two estimates of a tag; where only one dot is seen, the other is "
      "under it.";
  if (std::max(comparison.runs[0].seeds.size(), comparison.runs[1].seeds.size()) > 1) {
    figure.caption += " Shown are those of the first seed.";
  }
  if (step > 1) figure.caption += fmt::format(" One tag in {} is drawn.", step);
  figure.data = "tag,run,x_m,y_m,z_m\n";
  for (const ComparedTag& tag : comparison.tags) {
    for (std::size_t run = 0; run < 2; ++run) {
      if (const auto& p = tag.runs[run].position_m) {
        add_data(figure.data, tag.tag, comparison.runs[run].name, p->x(), p->y(), p->z());
      }
    }
  }
  return figure;
}

}  // namespace

std::vector<Figure> comparison_figures(const RunComparison& comparison,
                                       const std::vector<Silhouette>& geometry) {
  if (!any_locates(comparison)) return {};
  return {errors_figure(comparison), places_figure(comparison, geometry)};
}

}  // namespace tagfield
