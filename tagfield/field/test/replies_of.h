// SPDX-License-Identifier: Apache-2.0
/// @file
/// The replies of one update of an antenna that reads by the paper's model, all at once.
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
