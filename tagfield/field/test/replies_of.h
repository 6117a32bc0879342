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
  read_tags(antenna, p_WA, stamp, seed, tags, [&](std::span<const TagReply> some) {
    all.insert(all.end(), some.begin(), some.end());
  });
  return all;
}

}  // namespace tagfield
