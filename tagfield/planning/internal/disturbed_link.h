// SPDX-License-Identifier: Apache-2.0
/// @file
/// Effects of other tags and readers on a link.
#pragma once

#include <vector>

#include "tagfield/planning/link_explanation.h"

namespace tagfield {

/// The tags that couple with that of the question, as the link computation needs them.
struct Surrounded {
  TagSurroundings around;
  std::vector<NearTag> near;                           ///< Sorted by distance.
  std::vector<std::shared_ptr<const TagModel>> kinds;  ///< Models that `around` points to.
};
Surrounded tags_around(const RadioView& view, const LinkQuestion& question);

/// Fills in `link.interference` if the view's antenna models other readers. Returns their total
/// effect.
Disturbance add_interference(const Scenario& scenario, const LinkQuestion& question,
                             const RadioView& view, const TagEnd& tag, const RadioLink& of_link,
                             PhysicalLink& link);

}  // namespace tagfield
