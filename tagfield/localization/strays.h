// SPDX-License-Identifier: Apache-2.0
/// @file
/// Rows whose clock must have been wrong.
#pragma once

#include <vector>

#include "tagfield/base/time.h"

namespace tagfield {

/// From the first of some rows to the last.
struct StampRange {
  Time begin;
  Time end;
};

/// When there were rows with these stamps (in any order, at least one), but for strays: one row, or
/// up to one in a hundred, but fewer than locate a tag, that are further from all others than these
/// last, an hour at least. That is no pause of work, but a clock that was not set yet or fell back
/// to its epoch, and so nothing tells where the antenna was.
StampRange range_without_strays(std::vector<Time> stamps);

}  // namespace tagfield
