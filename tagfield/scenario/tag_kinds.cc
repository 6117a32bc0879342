// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/tag_kinds.h"

#include <set>

#include "tagfield/reader/radio_model.h"

namespace tagfield {

std::vector<std::shared_ptr<const TagModel>> kinds_of_tags(const Scenario& scenario) {
  std::vector<std::shared_ptr<const TagModel>> kinds;
  std::set<const TagModel*> seen;
  for (const TagSpec& tag : scenario.tags) {
    if (!seen.insert(tag.model.get()).second) continue;
    kinds.push_back(tag.model ? tag.model : default_tag_model());
  }
  return kinds;
}

}  // namespace tagfield
