// SPDX-License-Identifier: Apache-2.0
/// @file
/// The reads of a run that its page shows.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// Maximum number of reads kept for a page: 90 MB.
inline constexpr std::size_t kMaxDrawn = 500'000;

struct DrawnReads {
  std::vector<TagRead> reads;  ///< In the table's order.
  std::size_t of = 0;          ///< Number of reads in the table.
};

/// The reads of a table. If there are more than `most`, a selection in bounded memory: for each
/// antenna all reads of the tag that it reads most often, whose phases are unwrapped (in total at
/// most half of `most`, the earliest rows); each tag's first and last read, unless there are too
/// many tags; and every n-th of the others. Throws Error as read_reads_csv() does.
DrawnReads read_drawn(const std::string& path, std::size_t most = kMaxDrawn);

}  // namespace tagfield
