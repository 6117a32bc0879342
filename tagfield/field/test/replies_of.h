// SPDX-License-Identifier: Apache-2.0
/// @file
/// All replies of one update of an antenna with the paper's model, in one vector.
#pragma once

#include <vector>

#include "tagfield/field/tag_population.h"

namespace tagfield {

inline std::vector<TagReply> replies_of(const AntennaParameters& antenna,
                                        const Eigen::Vector3d& p_WA, Time stamp, std::uint64_t seed,
                                        const TagPopulation& tags) {
  std::vector<TagReply> all;
  TagsInRange near;
  read_tags(antenna, p_WA, stamp, seed, tags, near, [&](const PaperReads& some) {
    for (std::size_t i = 0; i < some.slots.size(); ++i) all.push_back(to_reply(some, i, stamp));
  });
  return all;
}

}  // namespace tagfield
