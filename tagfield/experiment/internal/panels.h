// SPDX-License-Identifier: Apache-2.0
/// @file
/// Small multiples: panels of equal size with a common scale upwards.
#pragma once

#include <string>
#include <vector>

#include "tagfield/report/axes.h"
#include "tagfield/report/svg.h"

namespace tagfield {

/// A value in a panel.
struct PanelMark {
  std::size_t series = 0;  ///< Whose colour it has.
  double x = 0.0;
  double y = 0.0;
  double low = 0.0;  ///< A bar is drawn where `high` is greater.
  double high = 0.0;
  std::string tooltip;
};

struct Panel {
  std::string title;
  std::vector<PanelMark> marks;  ///< By series, then by x.
};

/// What all panels share.
struct PanelForm {
  std::string x_title;
  std::string y_title;
  Scale x;                              ///< From data; where it is drawn is set here.
  std::vector<std::string> categories;  ///< Names of x = 0, 1, …, instead of ticks; "" for none.
  Scale y;
  bool connected = false;  ///< Whether a series' marks are joined by a line.
};

/// Draws the panels from left to right and downwards, below `top`, each with its own `forms` where
/// there are as many as panels, or all with the first. Sets the drawing's height.
void draw_panels(Svg& svg, const std::vector<Panel>& panels, const std::vector<PanelForm>& forms,
                 double top);

/// As many characters as a category's name may have, of so many in one of so many panels.
std::size_t most_category_name(std::size_t categories, std::size_t panels);

}  // namespace tagfield
