// SPDX-License-Identifier: Apache-2.0
/// @file
/// Division of reads into intervals that share an unknown, such as a phase offset.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

namespace tagfield {

/// Indices of the reads of one interval, in ascending order.
using ReadInterval = std::vector<std::size_t>;

/// Divides `count` reads, sorted by time, into intervals of one key that are up to `length` long,
/// in the order in which they begin. `key_of(i)` and `time_of(i)` are those of read i.
template <typename KeyOf, typename TimeOf, typename Length>
std::vector<ReadInterval> intervals_of(std::size_t count, const KeyOf& key_of,
                                       const TimeOf& time_of, const Length& length) {
  std::vector<ReadInterval> intervals;
  std::map<decltype(key_of(std::size_t{0})), std::size_t> open;
  for (std::size_t i = 0; i < count; ++i) {
    const auto [found, is_new] = open.emplace(key_of(i), intervals.size());
    if (!is_new && time_of(i) - time_of(intervals[found->second].front()) <= length) {
      intervals[found->second].push_back(i);
      continue;
    }
    found->second = intervals.size();
    intervals.push_back({i});
  }
  return intervals;
}

}  // namespace tagfield
