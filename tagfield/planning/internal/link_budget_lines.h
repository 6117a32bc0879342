// SPDX-License-Identifier: Apache-2.0
/// @file
/// A link's budget line by line.
#pragma once

#include <vector>

#include "tagfield/planning/link_explanation.h"

namespace tagfield {

/// One way, antennas' gains included.
struct OneWay {
  std::vector<BudgetLine> lines;       ///< Their sum is the way's gain.
  std::vector<SurfaceOnPath> between;  ///< On the direct way.
  std::vector<RadioPath> paths;        ///< Blocked ones too.
  std::vector<DiffractedPath> over_edges{};
  bool blocked = false;  ///< The direct one is.
};

/// From the view's antenna to `tag`, or from there to its receiving one; `gain_db` is the whole
/// way's.
OneWay one_way(const RadioView& view, const TagEnd& tag, double gain_db, bool receiver);

/// Fills in the lines of `link`, whose powers are set, and what is on the way.
void add_budget(const RadioView& view, const TagEnd& tag, const RadioLink& of_link,
                PhysicalLink& link);

}  // namespace tagfield
