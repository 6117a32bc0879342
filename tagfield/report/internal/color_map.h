// SPDX-License-Identifier: Apache-2.0
/// @file
/// Strength as a colour, as in the paper's Figs. 13 and 14: low blue, middle green, high red, and
/// the weaker the more transparent.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace tagfield {

/// Red, green, blue in [0, 1].
using Rgb = std::array<double, 3>;

/// Of a strength in [0, 1]; what is outside is taken as the nearest end.
Rgb strength_color(double strength);

/// In [0.4, 1], rising with the strength.
double strength_opacity(double strength);

/// "#rrggbb".
std::string hex_color(const Rgb& color);

/// The ends of the colour scale for these values: the middle nine tenths of them, because a few
/// reads that noise all but cancelled (eq. 5) lie far below the others. `values` must not be empty.
std::pair<double, double> color_range(std::vector<double> values);

/// `value` as a strength between `low` (0) and `high` (1); 0.5 where the two are equal.
double strength_of(double value, double low, double high);

}  // namespace tagfield
