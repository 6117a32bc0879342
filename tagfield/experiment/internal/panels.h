// SPDX-License-Identifier: Apache-2.0
/// @file
/// Small multiples: panels of equal size with a common vertical scale.
#pragma once

#include <string>
#include <vector>

#include "tagfield/report/axes.h"
#include "tagfield/report/svg.h"

namespace tagfield {

/// A value in a panel.
struct PanelMark {
  std::size_t series = 0;  ///< Determines the colour.
  double x = 0.0;
  double y = 0.0;
  double low = 0.0;  ///< A bar is drawn if `high` is greater.
  double high = 0.0;
  std::string tooltip;
};

struct Panel {
  std::string title;
  std::vector<PanelMark> marks;  ///< By series, then by x.
};

/// The format of panels.
struct PanelForm {
  std::string x_title;
  std::string y_title;
  Scale x;  ///< Set from data; its position in the drawing is set by draw_panels().
  std::vector<std::string> categories;  ///< Names of x = 0, 1, …, instead of ticks; "" for none.
  Scale y;
  bool connected = false;  ///< Whether a series' marks are joined by a line.
};

/// Draws the panels row by row below `top`, each with its own element of `forms` if there are as
/// many as panels, or else all with the first. Sets the drawing's height.
void draw_panels(Svg& svg, const std::vector<Panel>& panels, const std::vector<PanelForm>& forms,
                 double top);

/// Maximum length of a category's name [characters], given the number of categories in a panel and
/// of panels.
std::size_t max_category_name(std::size_t categories, std::size_t panels);

}  // namespace tagfield
