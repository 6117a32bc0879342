// SPDX-License-Identifier: Apache-2.0
/// @file
/// When tags passed antennas and a line on the floor.
#pragma once

#include <vector>

#include "tagfield/report/figures.h"
#include "tagfield/stream/tag_read.h"
#include "tagfield/tracking/tracker.h"

namespace tagfield {

/// One row per tag, in the order of the first of `orders`: a bar from its first to its last read,
/// and a mark at each passing. Only the first `kMaxRows` tags.
Figure passings_figure(const std::vector<TagRead>& reads, const std::vector<PassingOrder>& orders);

/// One row per tag: the time of each passing, with its standard deviation, and the probability that
/// it was before the next tag. HTML with a heading; "" if there are no passings.
std::string passings_table(const std::vector<PassingOrder>& orders);

}  // namespace tagfield
