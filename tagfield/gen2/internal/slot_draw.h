// SPDX-License-Identifier: Apache-2.0
/// @file
/// Which tags reply in the next slot of a frame, without a look at all others.
#pragma once

#include <cstdint>
#include <vector>

#include "tagfield/base/random.h"

namespace tagfield {

/// Moves to `repliers` (emptied first) those of `waiting` whose slot is the next of `slots_left` >=
/// 1 slots. Called for a frame's slots one after the other, this is the same law as when each tag
/// draws its slot in advance: one whose slot is not past is in the next of n with probability 1/n,
/// whatever the others do. The gaps between such tags in a list are geometric, so it takes one draw
/// for each that replies and one more. The order of `waiting` changes.
void draw_repliers(std::int64_t slots_left, RandomStream& stream,
                   std::vector<std::uint32_t>& waiting, std::vector<std::uint32_t>& repliers);

}  // namespace tagfield
