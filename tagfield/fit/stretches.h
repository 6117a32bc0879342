// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads cut into stretches that share an unknown, such as a phase offset.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

namespace tagfield {

/// Numbers of the reads that share it, in order.
using ReadStretch = std::vector<std::size_t>;

/// Cuts `count` reads, in order of time, into stretches of one key that are up to `length` long,
/// in the order in which they begin. `key_of(i)` and `time_of(i)` are those of a read.
template <typename KeyOf, typename TimeOf, typename Length>
std::vector<ReadStretch> stretches_of(std::size_t count, const KeyOf& key_of, const TimeOf& time_of,
                                      const Length& length) {
  std::vector<ReadStretch> stretches;
  std::map<decltype(key_of(std::size_t{0})), std::size_t> open;
  for (std::size_t i = 0; i < count; ++i) {
    const auto [found, is_new] = open.emplace(key_of(i), stretches.size());
    if (!is_new && time_of(i) - time_of(stretches[found->second].front()) <= length) {
      stretches[found->second].push_back(i);
      continue;
    }
    found->second = stretches.size();
    stretches.push_back({i});
  }
  return stretches;
}

}  // namespace tagfield
