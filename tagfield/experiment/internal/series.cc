// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/internal/series.h"

#include <fmt/format.h>

#include <algorithm>

#include "tagfield/experiment/bench/bench_figures.h"
#include "tagfield/report/style_sheet.h"

namespace tagfield {
namespace {

constexpr double kNameWidth = 176.0;
constexpr double kMarkHeight = 15.0;
constexpr double kGroupGap = 9.0;
constexpr double kSeriesBottom = 48.0;
constexpr std::size_t kMaxSeriesName = 22;
constexpr double kLeast = 1e-3;  // Smaller values are drawn here.
constexpr double kMost = 1e4;

double height_of(const MarkGroup& group) {
  return kMarkHeight * static_cast<double>(std::max<std::size_t>(group.marks.size(), 1)) +
         kGroupGap;
}

double drawable(double value) { return std::clamp(value, kLeast, kMost); }

Scale scale_of(const std::vector<MarkGroup>& groups) {
  double low = 0.8;
  double high = 1.25;
  for (const MarkGroup& group : groups) {
    for (const RowMark& mark : group.marks) {
      low = std::min(low, mark.value);
      high = std::max(high, mark.value);
      if (!(mark.band_high > mark.band_low)) continue;
      low = std::min(low, mark.band_low);
      high = std::max(high, mark.band_high);
    }
  }
  Scale scale = logarithmic_scale(drawable(low), drawable(high));
  scale.from = kNameWidth;
  scale.to = kDrawingWidth - 24.0;
  return scale;
}

void draw_mark(Svg& svg, const Bench& bench, const Axes& axes, const RowMark& mark, double y) {
  if (mark.band_high > mark.band_low) {
    const double left = place_on(axes.x, drawable(mark.band_low));
    const double right = place_on(axes.x, drawable(mark.band_high));
    add_rectangle(svg, {left, y - 5.0}, {std::max(right - left, 1.0), 10.0}, styled("band"));
  }
  add_circle(svg, {place_on(axes.x, drawable(mark.value)), y}, 4.5,
             styled(series_of(bench, mark.entry->name).dot), mark.tooltip);
}

void draw_group(Svg& svg, const Bench& bench, const Axes& axes, const MarkGroup& group,
                double top) {
  const double height = height_of(group);
  add_line(svg, {2.0, top}, {axes.x.to, top}, styled("grid"));
  add_text(svg, {2.0, top + 0.5 * height + 5.0}, shortened(group.condition, kMaxSeriesName),
           Anchor::kStart);
  double y = top + 0.5 * (kGroupGap + kMarkHeight);
  for (const RowMark& mark : group.marks) {
    draw_mark(svg, bench, axes, mark, y);
    y += kMarkHeight;
  }
}

std::vector<std::string> names_in(const Bench& bench, const std::vector<MarkGroup>& groups) {
  std::vector<std::string> names = method_names(bench);
  std::erase_if(names, [&](const std::string& name) {
    for (const MarkGroup& group : groups) {
      for (const RowMark& mark : group.marks) {
        if (mark.entry->name == name) return false;
      }
    }
    return true;
  });
  return names;
}

}  // namespace

Series series_of(const Bench& bench, const std::string& name) {
  const std::vector<std::string> names = method_names(bench);
  const auto found = std::find(names.begin(), names.end(), name);
  const auto color = static_cast<std::size_t>(found - names.begin()) % kSeriesColors;
  return {fmt::format("line{}", color), fmt::format("dot{}", color)};
}

std::vector<LegendEntry> legend_of(const Bench& bench, const std::vector<std::string>& names,
                                   Symbol symbol) {
  std::vector<LegendEntry> legend;
  legend.reserve(names.size());
  for (const std::string& name : names) {
    const Series series = series_of(bench, name);
    legend.push_back({symbol, symbol == Symbol::kLine ? series.line : series.dot,
                      shortened(name, kMaxSeriesName)});
  }
  return legend;
}

void draw_groups(Svg& svg, const Bench& bench, const std::vector<MarkGroup>& groups,
                 const std::string& title) {
  const double top =
      draw_legend(svg, legend_of(bench, names_in(bench, groups), Symbol::kSquare)) + 4.0;
  double bottom = top;
  for (const MarkGroup& group : groups) bottom += height_of(group);
  Axes axes{scale_of(groups), {}};
  axes.y.to = top;
  axes.y.from = bottom;
  svg.height = bottom + kSeriesBottom;
  draw_x_axis(svg, axes, title);
  const double one = place_on(axes.x, 1.0);
  add_line(svg, {one, top}, {one, bottom}, styled("rule"));
  double y = top;
  for (const MarkGroup& group : groups) {
    draw_group(svg, bench, axes, group, y);
    y += height_of(group);
  }
}

}  // namespace tagfield
