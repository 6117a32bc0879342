// SPDX-License-Identifier: Apache-2.0
/// @file
/// Statistics of reads, collected read by read, so also for reads that don't fit in memory.
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
  std::size_t backwards = 0;      ///< Reads earlier than the previous one of the same antenna.
  std::vector<std::string> tags;  ///< In order of their first reads.
  std::unordered_map<std::string, std::size_t> count_by_tag;
  std::unordered_map<std::string, Time> last_by_antenna;  ///< Stamp of each antenna's last read.
  std::set<double> carriers_hz;
  bool has_doppler = false;  ///< Some read reports it.
  Time first = Time::max();  ///< Earliest and latest stamp.
  Time last = Time::min();
};

/// Adds a read.
void add(const TagRead& read, ReadOverview& overview);

ReadOverview overview_of(const std::vector<TagRead>& reads);

}  // namespace tagfield
