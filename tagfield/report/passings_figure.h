// SPDX-License-Identifier: Apache-2.0
/// @file
/// When tags passed what they pass: gates, and a line on the floor.
#pragma once

#include <vector>

#include "tagfield/report/figures.h"
#include "tagfield/stream/tag_read.h"
#include "tagfield/tracking/tracker.h"

namespace tagfield {

/// A row a tag, in the order of the first of `orders`: from its first read to its last, and a mark
/// where it passed each thing. Only the first `kMostRows` tags.
Figure passings_figure(const std::vector<TagRead>& reads, const std::vector<PassingOrder>& orders);

/// A row a tag: when it passed each thing, with the standard deviation, and how surely before the
/// tag that follows. HTML with its heading; "" where nothing was passed.
std::string passings_table(const std::vector<PassingOrder>& orders);

}  // namespace tagfield
