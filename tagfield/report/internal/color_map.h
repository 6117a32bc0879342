// SPDX-License-Identifier: Apache-2.0
/// @file
/// Ordered quantities as colours: from dark blue over green to yellow with evenly increasing
/// lightness, so that the order is visible with red-green colour blindness, too. The paper's Figs.
/// 13 and 14 end in red; as in those, weaker signals are more transparent.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace tagfield {

/// Red, green, blue in [0, 1].
using Rgb = std::array<double, 3>;

/// Colour of a strength in [0, 1]; values outside are clamped.
Rgb strength_color(double strength);

/// Opacity in [0.7, 1], increasing with the strength.
double strength_opacity(double strength);

/// "#rrggbb".
std::string hex_color(const Rgb& color);

/// The range of the colour scale for these values: the middle 90 %, because a few reads that noise
/// almost cancelled (eq. 5) are far below the others. `values` must not be empty.
std::pair<double, double> color_range(std::vector<double> values);

/// `value` as a strength between `low` (0) and `high` (1); 0.5 if the two are equal.
double strength_of(double value, double low, double high);

}  // namespace tagfield
