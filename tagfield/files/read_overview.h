// SPDX-License-Identifier: Apache-2.0
/// @file
/// What there is in reads, gathered read by read, of those too that don't fit in memory.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "tagfield/stream/tag_read.h"

namespace tagfield {

struct ReadOverview {
  std::size_t count = 0;
  std::size_t backwards = 0;      ///< Earlier than the one before them of the same antenna.
  std::vector<std::string> tags;  ///< In the order in which they were first read.
  std::unordered_map<std::string, std::size_t> count_by_tag;
  std::unordered_map<std::string, Time> last_by_antenna;  ///< Stamp of each antenna's last read.
  std::set<double> carriers_hz;
  bool has_doppler = false;  ///< Some read tells it.
  Time first = Time::max();  ///< Least stamp, and greatest.
  Time last = Time::min();
};

/// Counts one more read.
void add(const TagRead& read, ReadOverview& overview);

ReadOverview overview_of(const std::vector<TagRead>& reads);

}  // namespace tagfield
