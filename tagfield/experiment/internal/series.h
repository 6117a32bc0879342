// SPDX-License-Identifier: Apache-2.0
/// @file
/// Common parts of a comparison's figures: colours of methods, legends, rows of conditions.
#pragma once

#include <string>
#include <vector>

#include "tagfield/experiment/bench/bench.h"
#include "tagfield/report/axes.h"
#include "tagfield/report/svg.h"

namespace tagfield {

/// The CSS classes of a method's lines and dots.
struct Series {
  std::string line;
  std::string dot;
};
Series series_of(const Bench& bench, const std::string& name);

/// An entry for each of these methods.
std::vector<LegendEntry> legend_of(const Bench& bench, const std::vector<std::string>& names,
                                   Symbol symbol);

/// A mark drawn in a row, with the entry that it belongs to.
struct RowMark {
  const BenchEntry* entry = nullptr;
  double value = 0.0;
  std::string tooltip;
  double band_low = 0.0;  ///< Drawn if `band_high` is greater.
  double band_high = 0.0;
};

/// Marks of one condition, one below another.
struct MarkGroup {
  std::string condition;
  std::vector<RowMark> marks;
};

/// Draws the groups with their names on a logarithmic axis, a line at 1, and the methods' legend.
void draw_groups(Svg& svg, const Bench& bench, const std::vector<MarkGroup>& groups,
                 const std::string& title);

}  // namespace tagfield
