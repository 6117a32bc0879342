// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tagfield/report/internal/color_map.h"
#include "tagfield/report/internal/ticks.h"

namespace tagfield {
namespace {

constexpr double kLegendRow = 24.0;
constexpr double kLegendGap = 16.0;
constexpr double kSymbolWidth = 28.0;

double fraction_of(const Scale& scale, double value) {
  if (!scale.logarithmic) return (value - scale.low) / (scale.high - scale.low);
  return std::log(std::max(value, scale.low) / scale.low) / std::log(scale.high / scale.low);
}

/// Round number of the form 1, 2 or 5 times a power of ten at or below `value` > 0.
double round_below(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value) + 1e-9));
  for (const double lead : {5.0, 2.0}) {
    if (lead * power <= value * (1.0 + 1e-9)) return lead * power;
  }
  return power;
}

double round_above(double value) { return 1.0 / round_below(1.0 / value); }

std::vector<std::string> labels_of(const Scale& scale) {
  return scale.logarithmic ? logarithmic_labels(scale.ticks) : tick_labels(scale.ticks);
}

void draw_symbol(Svg& svg, const LegendEntry& entry, const Place& center) {
  const Look look = styled(entry.css_class);
  switch (entry.symbol) {
    case Symbol::kLine:
      add_line(svg, center - Place(11, 0), center + Place(11, 0), look);
      break;
    case Symbol::kDiamond:
      add_diamond(svg, center, 7, look);
      break;
    case Symbol::kCross:
      add_cross(svg, center, 5, look);
      break;
    case Symbol::kDot:
      add_circle(svg, center, 3, look);
      break;
    case Symbol::kRing:
      add_circle(svg, center, 5, look);
      break;
    case Symbol::kSquare:
      add_rectangle(svg, center - Place(7, 6), Place(14, 12), look);
      break;
  }
}

std::string span_of(const Scale& scale) {
  return fmt::format("{:.7g} {:.7g} {} {} {}", scale.low, scale.high, compact(scale.from),
                     compact(scale.to), scale.logarithmic ? "log" : "lin");
}

/// data-x, data-y: "low high from to lin|log", coordinates in the drawing; data-x-name … the
/// titles.
void describe_axes(Svg& svg, const Axes& axes, const std::string& x_title,
                   const std::string& y_title) {
  begin_group(svg,
              fmt::format("class=\"axes\" data-x=\"{}\" data-y=\"{}\" data-x-name=\"{}\" "
                          "data-y-name=\"{}\"",
                          span_of(axes.x), span_of(axes.y), escaped(x_title), escaped(y_title)));
  end_group(svg);
}

void draw_x_grid(Svg& svg, const Axes& axes, const std::string& title) {
  const std::vector<std::string> labels = labels_of(axes.x);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const double x = place_on(axes.x, axes.x.ticks[i]);
    add_line(svg, {x, axes.y.from}, {x, axes.y.to}, styled("grid"));
    add_text(svg, {x, axes.y.from + 18.0}, labels[i], Anchor::kMiddle, "faint");
  }
  add_text(svg, {axes.x.to, axes.y.from + 40.0}, title, Anchor::kEnd);
}

}  // namespace

double row_height(std::size_t rows) {
  constexpr double kLeast = 26.0;
  constexpr double kMinTogether = 150.0;
  return std::max(kLeast, kMinTogether / static_cast<double>(std::max<std::size_t>(rows, 1)));
}

double place_on(const Scale& scale, double value) {
  return scale.from + fraction_of(scale, value) * (scale.to - scale.from);
}

Place place_in(const Axes& axes, double x, double y) {
  return {place_on(axes.x, x), place_on(axes.y, y)};
}

Scale round_scale(double low, double high, int count) {
  Scale scale;
  scale.ticks = covering_ticks(low, high, count);
  scale.low = scale.ticks.front();
  scale.high = scale.ticks.back();
  return scale;
}

Scale tight_scale(double low, double high, int count) {
  return {low, high, 0.0, 1.0, inner_ticks(low, high, count), false};
}

Scale logarithmic_scale(double low, double high) {
  Scale scale;
  scale.logarithmic = true;
  scale.low = round_below(low);
  scale.high = std::max(round_above(high), 2.0 * scale.low);
  scale.ticks = logarithmic_ticks(scale.low, scale.high);
  return scale;
}

void draw_x_axis(Svg& svg, const Axes& axes, const std::string& title) {
  describe_axes(svg, axes, title, "");
  draw_x_grid(svg, axes, title);
}

void draw_axes(Svg& svg, const Axes& axes, const std::string& x_title, const std::string& y_title) {
  describe_axes(svg, axes, x_title, y_title);
  draw_x_grid(svg, axes, x_title);
  const std::vector<std::string> labels = labels_of(axes.y);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const double y = place_on(axes.y, axes.y.ticks[i]);
    add_line(svg, {axes.x.from, y}, {axes.x.to, y}, styled("grid"));
    add_text(svg, {axes.x.from - 7.0, y + 5.0}, labels[i], Anchor::kEnd, "faint");
  }
  add_line(svg, {axes.x.from, axes.y.from}, {axes.x.to, axes.y.from}, styled("axis"));
  add_text(svg, {2.0, axes.y.to - 14.0}, y_title, Anchor::kStart);
}

double draw_legend(Svg& svg, const std::vector<LegendEntry>& entries) {
  double x = 2.0;
  double y = 12.0;
  for (const LegendEntry& entry : entries) {
    const double width = kSymbolWidth + text_width(entry.text);
    if (x > 2.0 && x + width > kDrawingWidth) {
      x = 2.0;
      y += kLegendRow;
    }
    begin_group(svg, fmt::format("class=\"key\" data-key=\"{}\"", escaped(entry.css_class)));
    draw_symbol(svg, entry, {x + 11.0, y});
    add_text(svg, {x + kSymbolWidth, y + 5.0}, entry.text, Anchor::kStart);
    end_group(svg);
    x += width + kLegendGap;
  }
  return y + kLegendRow - 8.0;
}

void draw_color_bar(Svg& svg, double y, double low, double high) {
  constexpr int kSteps = 48;
  constexpr double kTitleWidth = 108.0;
  const double width = (kDrawingWidth - kTitleWidth - 24.0) / kSteps;
  add_text(svg, {2.0, y + 12.0}, "RSSI [dBm]", Anchor::kStart);
  for (int i = 0; i < kSteps; ++i) {
    const double strength = (i + 0.5) / kSteps;
    add_rectangle(svg, {kTitleWidth + i * width, y}, {width + (i + 1 < kSteps ? 0.3 : 0.0), 15.0},
                  filled(hex_color(strength_color(strength)), strength_opacity(strength)));
  }
  Scale scale{low, high, kTitleWidth, kDrawingWidth - 24.0, inner_ticks(low, high, 5), false};
  if (!(high > low)) scale = {low - 0.5, low + 0.5, scale.from, scale.to, {low}, false};
  const std::vector<std::string> labels = tick_labels(scale.ticks);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const double x = place_on(scale, scale.ticks[i]);
    add_line(svg, {x, y + 15.0}, {x, y + 20.0}, styled("axis"));
    add_text(svg, {x, y + 36.0}, labels[i], Anchor::kMiddle, "faint");
  }
}

}  // namespace tagfield
