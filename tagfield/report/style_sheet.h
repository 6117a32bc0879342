// SPDX-License-Identifier: Apache-2.0
/// @file
/// Colours and style sheets: one set of rules for the figures, used in the page with light and dark
/// colours and in standalone files with light ones.
#pragma once

#include <cstddef>
#include <string>

namespace tagfield {

/// Colours in CSS notation.
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
  std::string map_free;  ///< A grid map is light on the dark page, too, but not glaring.
  std::string map_occupied;
  std::string map_unknown;
};

Palette light_palette();
Palette dark_palette();

/// Number of colours for series of one kind: classes line0, dot0, line1, …, with good contrast to a
/// light and a dark background.
inline constexpr std::size_t kSeriesColors = 10;

/// Rules for the classes that figures use.
std::string figure_style(const Palette& palette);

/// Rules for the whole page, including figures, light or dark as preferred by the reader's device.
std::string page_style();

}  // namespace tagfield
