// SPDX-License-Identifier: Apache-2.0
/// @file
/// Colours and style sheets: one set of rules for the figures, worn by the page in light and dark
/// and by the single files in light.
#pragma once

#include <cstddef>
#include <string>

namespace tagfield {

/// Colours as CSS writes them.
struct Palette {
  std::string paper;  ///< Background.
  std::string panel;  ///< Background of a box on it.
  std::string ink;
  std::string muted;
  std::string grid;
  std::string wall;
  std::string wall_edge;
  std::string truth;     ///< Magenta, as in the paper.
  std::string estimate;  ///< Blue, as in the paper.
  std::string believed;
  std::string map_free;  ///< A map of cells is light on the dark page too, but not glaring.
  std::string map_occupied;
  std::string map_unknown;
};

Palette light_palette();
Palette dark_palette();

/// How many colours there are for things of one kind: classes line0, dot0, line1, …, which stand
/// out from light and dark paper.
inline constexpr std::size_t kSeriesColors = 10;

/// Rules for the classes that figures use.
std::string figure_style(const Palette& palette);

/// Rules of the whole page, figures included, light or dark as the reader's device asks.
std::string page_style();

}  // namespace tagfield
