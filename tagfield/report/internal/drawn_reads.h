// SPDX-License-Identifier: Apache-2.0
/// @file
/// Those reads of a run that its page shows.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// More are not kept for a page: 90 MB.
inline constexpr std::size_t kMostDrawn = 500'000;

struct DrawnReads {
  std::vector<TagRead> reads;  ///< In the table's order.
  std::size_t of = 0;          ///< Reads in the table.
};

/// The reads of a table. Of more than `most` these, in bounded memory: all of the tag that an
/// antenna reads most often, whose phases are unwrapped (those in the beginning, where they are
/// over half of `most` for all antennas); each tag's first and last, unless tags are too many for
/// that; every second, third, … of the others. Throws Error as read_reads_csv() does.
DrawnReads read_drawn(const std::string& path, std::size_t most = kMostDrawn);

}  // namespace tagfield
