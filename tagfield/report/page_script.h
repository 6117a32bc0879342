// SPDX-License-Identifier: Apache-2.0
/// @file
/// Scripts of pages, and the hashes by which a page allows only them to run.
#pragma once

#include <string>

namespace tagfield {

struct PageScript {
  const char* text;
  const char* hash;  ///< "sha256-…" of `text`; checked by tests/command/plan_test.py.
};

/// Sorts tables on a click on a column header; long ones get a field to filter their rows, wide
/// ones a note that they scroll.
const PageScript& table_script();

/// Shows the value under the pointer in figures, from their marks' tooltips or their axes; a click
/// on an entry of the legend hides or shows the series.
const PageScript& figure_script();

/// Zooms figures with axes by buttons, a double click or Ctrl and the wheel, after which they can
/// be dragged; marks keep their size. A click on a tag's mark shows its row in the table of tags,
/// one on the row's name its marks.
const PageScript& link_script();

/// The slider and the comparison of a plan's page.
const PageScript& plan_script();

/// The script in an element that page_head() allows to run by its hash.
std::string script_html(const PageScript& script);

}  // namespace tagfield
