// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/read_overview.h"

#include <algorithm>

namespace tagfield {

void add(const TagRead& read, ReadOverview& overview) {
  ++overview.count;
  const auto [of_tag, is_new_tag] = overview.count_by_tag.try_emplace(read.tag, 0);
  if (is_new_tag) overview.tags.push_back(read.tag);
  ++of_tag->second;
  const auto [last, is_first] = overview.last_by_antenna.try_emplace(read.antenna, read.stamp);
  if (!is_first && read.stamp < last->second) ++overview.backwards;
  last->second = read.stamp;
  overview.carriers_hz.insert(read.frequency_hz);
  overview.has_doppler = overview.has_doppler || read.doppler_hz.has_value();
  overview.first = std::min(overview.first, read.stamp);
  overview.last = std::max(overview.last, read.stamp);
}

ReadOverview overview_of(const std::vector<TagRead>& reads) {
  ReadOverview overview;
  for (const TagRead& read : reads) add(read, overview);
  return overview;
}

}  // namespace tagfield
