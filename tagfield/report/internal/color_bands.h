// SPDX-License-Identifier: Apache-2.0
/// @file
/// Values as colour bands, for maps of cells: few enough to be distinguishable on white and on
/// near-black, and all on one colour scale (color_map.h).
#pragma once

#include <string>
#include <vector>

#include "tagfield/report/svg.h"

namespace tagfield {

/// Band i contains the values in [edges[i - 1], edges[i]); the first and the last are open-ended.
struct ColorBands {
  std::string title;                ///< With the unit.
  std::vector<double> edges;        ///< Ascending.
  std::vector<std::string> colors;  ///< One more than edges: "#rrggbb"; "" for not drawn.
  std::vector<std::string> labels;  ///< Of the edges.
};

std::size_t band_of(const ColorBands& bands, double value);

/// The range of a band, with its title: "margin [dB]: 3 to 10", "below −30", "30 or more".
std::string words_of_band(const ColorBands& bands, std::size_t band);

/// The look of a band's cells; pages show `words` when the pointer is over them.
Look band_look(const std::string& color, const std::string& words);

/// Dark blue to yellow in steps of 5 dB, or larger ones if that would give over 12 bands, covering
/// `values`, which may be empty.
ColorBands power_bands(const std::string& title, std::vector<double> values);
/// Dark blue below 0 dB, green to yellow above.
ColorBands margin_bands();
/// Dark to light from 1 % upwards.
ColorBands probability_bands();

/// Dark to light in ten steps from 0 to `most`, in whole tenths.
ColorBands agreement_bands(double most);

/// Draws a horizontal bar of the bands, preceded by their title, with its top at `y`. Needs a
/// height of 44.
void draw_band_bar(Svg& svg, double y, const ColorBands& bands);

/// Colours for unordered categories: eight, then the same lighter, then darker, repeated after 24.
/// With more than kPlainKinds, categories need another mark, too.
inline constexpr std::size_t kPlainKinds = 8;
const std::string& color_of_kind(std::size_t number);

}  // namespace tagfield
