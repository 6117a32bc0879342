// SPDX-License-Identifier: Apache-2.0
/// @file
/// Rows whose stamps are from a wrong clock.
#pragma once

#include <vector>

#include "tagfield/base/time.h"

namespace tagfield {

/// Range of stamps from the first row to the last.
struct StampRange {
  Time begin;
  Time end;
};

/// Range of the rows with these stamps (in any order, at least one), without strays. Strays are one
/// row, or up to one in a hundred but fewer than it takes to locate a tag, that are further in time
/// from all others than the duration of these, at least an hour. This is taken not for a pause in
/// operation but for a clock that was not yet set or fell back to its epoch, so that the antenna's
/// position is unknown.
StampRange range_without_strays(std::vector<Time> stamps);

}  // namespace tagfield
