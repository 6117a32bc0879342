// SPDX-License-Identifier: Apache-2.0
/// @file
/// A link's budget line by line.
#pragma once

#include <vector>

#include "tagfield/planning/link_explanation.h"

namespace tagfield {

/// One direction of a link, including antenna gains.
struct OneWayLink {
  std::vector<BudgetLine> lines;       ///< Their sum is the one-way gain.
  std::vector<SurfaceOnPath> between;  ///< On the direct path.
  std::vector<RadioPath> paths;        ///< Blocked ones too.
  std::vector<DiffractedPath> over_edges{};
  bool blocked = false;  ///< Whether the direct path is blocked.
};

/// From the view's antenna to `tag`, or from there to its receiving one; `gain_db` is the total
/// one-way gain.
OneWayLink one_way(const RadioView& view, const TagEnd& tag, double gain_db, bool receiver);

/// Fills in the budget lines of `link`, whose powers must be set, and the obstacles on its paths.
void add_budget(const RadioView& view, const TagEnd& tag, const RadioLink& of_link,
                PhysicalLink& link);

}  // namespace tagfield
