// SPDX-License-Identifier: Apache-2.0
/// @file
/// Ordered quantities as colours: from dark blue over green to yellow, evenly lighter, so that also
/// those who don't see red and green apart see the order. The paper's Figs. 13 and 14 end in red;
/// as in those, the weaker a signal, the more transparent it is.
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

/// In [0.7, 1], rising with the strength.
double strength_opacity(double strength);

/// "#rrggbb".
std::string hex_color(const Rgb& color);

/// The ends of the colour scale for these values: the middle nine tenths of them, because a few
/// reads that noise all but cancelled (eq. 5) lie far below the others. `values` must not be empty.
std::pair<double, double> color_range(std::vector<double> values);

/// `value` as a strength between `low` (0) and `high` (1); 0.5 where the two are equal.
double strength_of(double value, double low, double high);

}  // namespace tagfield
