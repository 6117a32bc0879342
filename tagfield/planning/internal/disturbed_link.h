// SPDX-License-Identifier: Apache-2.0
/// @file
/// What tags and readers beside a link do to it.
#pragma once

#include <vector>

#include "tagfield/planning/link_explanation.h"

namespace tagfield {

/// The tags that couple with the one asked about, as the air takes them.
struct Surrounded {
  TagSurroundings around;
  std::vector<NearTag> near;                           ///< By rising distance.
  std::vector<std::shared_ptr<const TagModel>> kinds;  ///< That `around` points to.
};
Surrounded tags_around(const RadioView& view, const LinkQuestion& question);

/// Fills in `link.interference`, where the view's antenna minds other readers; what that comes to.
Disturbance add_interference(const Scenario& scenario, const LinkQuestion& question,
                             const RadioView& view, const TagEnd& tag, const RadioLink& of_link,
                             PhysicalLink& link);

}  // namespace tagfield
