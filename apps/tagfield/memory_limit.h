// SPDX-License-Identifier: Apache-2.0
/// @file
/// How much memory the program takes at most.
#pragma once

namespace tagfield {

/// From now on what does not fit into the memory that the machine (or the container) has left is
/// refused to the program, which then throws std::bad_alloc: otherwise the system would end some
/// process, this one or another, without a word. A lower limit of the user's own stays.
void limit_memory_to_what_is_left();

}  // namespace tagfield
