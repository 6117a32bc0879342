// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/internal/panels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tagfield/report/style_sheet.h"

namespace tagfield {
namespace {

constexpr double kPanelLeft = 50.0;   // For the labels of the vertical scale.
constexpr double kPanelRight = 20.0;  // For half of the last label of the horizontal scale.
constexpr double kPanelHead = 30.0;
constexpr double kPanelFoot = 32.0;
constexpr double kCharacterWidth = 8.0;

std::size_t columns_for(std::size_t panels) { return panels <= 1 ? 1 : panels <= 4 ? 2 : 3; }

double panel_height(std::size_t columns) {
  return columns == 1 ? 250.0 : columns == 2 ? 170.0 : 130.0;
}

double panel_width(std::size_t columns) {
  return kDrawingWidth / static_cast<double>(columns) - kPanelLeft - kPanelRight;
}

std::string class_of(const char* kind, std::size_t series) {
  return fmt::format("{}{}", kind, series % kSeriesColors);
}

void draw_frame(Svg& svg, const PanelForm& form, const Axes& axes) {
  Axes shown = axes;
  if (!form.categories.empty()) shown.x.ticks.clear();
  draw_axes(svg, shown, "", "");
  for (std::size_t i = 0; i < form.categories.size(); ++i) {
    const double x = place_on(axes.x, static_cast<double>(i));
    add_text(svg, {x, axes.y.from + 18.0}, form.categories[i], Anchor::kMiddle, "faint");
  }
}

void draw_mark_of(Svg& svg, const Axes& axes, const PanelMark& mark, double radius) {
  if (mark.high > mark.low) {
    add_line(svg, place_in(axes, mark.x, mark.low), place_in(axes, mark.x, mark.high),
             styled(class_of("line", mark.series)));
  }
  add_circle(svg, place_in(axes, mark.x, mark.y), radius, styled(class_of("dot", mark.series)),
             mark.tooltip);
}

void join_marks(Svg& svg, const Axes& axes, const Panel& panel) {
  for (std::size_t i = 0; i < panel.marks.size();) {
    const std::size_t series = panel.marks[i].series;
    std::vector<Place> places;
    for (; i < panel.marks.size() && panel.marks[i].series == series; ++i) {
      places.push_back(place_in(axes, panel.marks[i].x, panel.marks[i].y));
    }
    add_polyline(svg, places, styled(class_of("line", series)));
  }
}

}  // namespace

std::size_t max_category_name(std::size_t categories, std::size_t panels) {
  const double width = panel_width(columns_for(panels));
  return static_cast<std::size_t>(
      width / static_cast<double>(std::max<std::size_t>(categories, 1)) / kCharacterWidth);
}

void draw_panels(Svg& svg, const std::vector<Panel>& panels, const std::vector<PanelForm>& forms,
                 double top) {
  const std::size_t columns = columns_for(panels.size());
  const double height = panel_height(columns);
  add_text(svg, {2.0, top + 14.0}, forms.front().y_title, Anchor::kStart, "faint");
  double bottom = top;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const PanelForm& form = forms[forms.size() == panels.size() ? i : 0];
    Axes axes{form.x, form.y};
    const double left =
        kDrawingWidth / static_cast<double>(columns) * static_cast<double>(i % columns);
    axes.x.from = left + kPanelLeft;
    axes.x.to = axes.x.from + panel_width(columns);
    axes.y.to = top + 20.0 + kPanelHead +
                std::floor(static_cast<double>(i) / static_cast<double>(columns)) *
                    (height + kPanelHead + kPanelFoot);
    axes.y.from = axes.y.to + height;
    draw_frame(svg, form, axes);
    add_text(svg, {axes.x.from, axes.y.to - 9.0}, panels[i].title, Anchor::kStart);
    if (form.connected) join_marks(svg, axes, panels[i]);
    for (const PanelMark& mark : panels[i].marks) {
      draw_mark_of(svg, axes, mark, form.connected ? 3.5 : 3.0);
    }
    bottom = axes.y.from + kPanelFoot;
  }
  if (!forms.front().x_title.empty()) {
    add_text(svg, {kDrawingWidth - kPanelRight, bottom + 10.0}, forms.front().x_title,
             Anchor::kEnd);
    bottom += 18.0;
  }
  svg.height = bottom;
}

}  // namespace tagfield
