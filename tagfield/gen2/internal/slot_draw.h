// SPDX-License-Identifier: Apache-2.0
/// @file
/// Selection of the tags that reply in the next slot of a frame, without visiting all others.
#pragma once

#include <cstdint>
#include <vector>

#include "tagfield/base/random.h"

namespace tagfield {

/// Moves the tags of `waiting` that reply in the next of `slots_left` >= 1 slots to `repliers`
/// (cleared first). Called once per slot of a frame, this follows the same distribution as each tag
/// drawing its slot in advance: a tag that has not yet replied is in the next of n slots with
/// probability 1/n, independently of the others. The gaps between such tags in a list are
/// geometrically distributed, so one draw per replying tag plus one is enough. The order of
/// `waiting` changes.
void draw_repliers(std::int64_t slots_left, RandomStream& stream,
                   std::vector<std::uint32_t>& waiting, std::vector<std::uint32_t>& repliers);

}  // namespace tagfield
