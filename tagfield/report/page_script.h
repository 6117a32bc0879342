// SPDX-License-Identifier: Apache-2.0
/// @file
/// Scripts that pages carry, and the hashes by which alone a page lets them run.
#pragma once

#include <string>

namespace tagfield {

struct PageScript {
  const char* text;
  const char* hash;  ///< "sha256-…" of `text`; tests/command/plan_test.py computes it again.
};

/// Tables sort by a click on a column's head; long ones get a field to filter their rows, wide ones
/// a line that says that they scroll.
const PageScript& table_script();

/// Figures say the value under the pointer, by their marks' tooltips or by their axes; a click on
/// an entry of the legend hides the series, and shows it again.
const PageScript& figure_script();

/// Figures with axes are zoomed by buttons, a double click or Ctrl and the wheel, and dragged then,
/// their marks staying as large as they are; a click on a tag's mark shows its row in the table of
/// tags, one on the row's name its marks.
const PageScript& link_script();

/// The slider and the comparison of a plan's page.
const PageScript& plan_script();

/// In an element that page_head() lets run by its hash.
std::string script_html(const PageScript& script);

}  // namespace tagfield
