// SPDX-License-Identifier: Apache-2.0
/// @file
/// Axes of a figure: the mapping from data to drawing coordinates, with grid, tick labels and
/// titles.
#pragma once

#include <string>
#include <vector>

#include "tagfield/report/svg.h"

namespace tagfield {

/// One axis: data from `low` to `high` are mapped to `from` … `to` in the drawing.
struct Scale {
  double low = 0.0;
  double high = 1.0;
  double from = 0.0;
  double to = 1.0;
  std::vector<double> ticks;
  bool logarithmic = false;  ///< If so, 0 < low; smaller values are clamped to `low`.
};

struct Axes {
  Scale x;
  Scale y;  ///< `from` is the bottom, hence the greater value.
};

double place_on(const Scale& scale, double value);
Place place_in(const Axes& axes, double x, double y);

/// An axis that covers low … high with round ends and about `count` ticks.
Scale round_scale(double low, double high, int count);
/// An axis from exactly low to high, low < high, with about `count` ticks.
Scale tight_scale(double low, double high, int count);
/// Like round_scale, but logarithmic, with 0 < low, ends at ticks of 1, 2 or 5 times powers of ten.
Scale logarithmic_scale(double low, double high);

/// Draws grid, tick labels, and titles (with units): x below the right end, y above the left. An
/// empty group with the class "axes" states their ranges, from which a page's script computes
/// values.
void draw_axes(Svg& svg, const Axes& axes, const std::string& x_title, const std::string& y_title);
/// Draws only the vertical grid lines, with labels and title, for figures with named rows.
void draw_x_axis(Svg& svg, const Axes& axes, const std::string& title);

/// Height of each of `rows` named rows; a few rows are higher, so that the figure is not too flat.
double row_height(std::size_t rows);

/// An entry of a legend.
enum class Symbol { kLine, kDiamond, kCross, kDot, kRing, kSquare };
struct LegendEntry {
  Symbol symbol = Symbol::kLine;
  std::string css_class;
  std::string text;
};

/// Draws the entries from the top left, wrapped to the width; returns the height used. Each is a
/// group with the class "key", and with the series' own class as data-key.
double draw_legend(Svg& svg, const std::vector<LegendEntry>& entries);

/// Draws a horizontal colour bar from `low` to `high` [dBm], with its top at `y`. Needs a height of
/// 44.
void draw_color_bar(Svg& svg, double y, double low, double high);

}  // namespace tagfield
