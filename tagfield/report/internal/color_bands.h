// SPDX-License-Identifier: Apache-2.0
/// @file
/// Values as bands of colour, for maps of cells: few enough to be distinguished, on white and on
/// near-black, and all on one scale (color_map.h).
#pragma once

#include <string>
#include <vector>

#include "tagfield/report/svg.h"

namespace tagfield {

/// Band i holds the values from edges[i - 1] up to below edges[i]; the first and the last are open.
struct ColorBands {
  std::string title;                ///< With the unit.
  std::vector<double> edges;        ///< Rising.
  std::vector<std::string> colors;  ///< One more than edges: "#rrggbb"; "" is not drawn.
  std::vector<std::string> labels;  ///< Of the edges.
};

std::size_t band_of(const ColorBands& bands, double value);

/// What a band holds, with its title: "margin [dB]: 3 to 10", "below −30", "30 or more".
std::string words_of_band(const ColorBands& bands, std::size_t band);

/// How a band's cells look; pages say `words` where a pointer is over them.
Look band_look(const std::string& color, const std::string& words);

/// Dark blue to yellow in steps of 5 dB, or more where that would be over 12 bands, around
/// `values`, which may be empty.
ColorBands power_bands(const std::string& title, std::vector<double> values);
/// Dark blue below 0 dB, green to yellow from there on.
ColorBands margin_bands();
/// Dark to light from 1 % on.
ColorBands probability_bands();

/// Dark to light in ten steps from 0 to `most`, in whole tenths.
ColorBands agreement_bands(double most);

/// A horizontal bar of the bands with its title before it, the top at `y`. Needs 44 of height.
void draw_band_bar(Svg& svg, double y, const ColorBands& bands);

/// Colours for things that have no order, over and over.
const std::string& color_of_kind(std::size_t number);

}  // namespace tagfield
