// SPDX-License-Identifier: Apache-2.0
/// @file
/// A limit on the program's memory.
#pragma once

namespace tagfield {

/// From now on, allocations beyond the memory that the machine (or the container) has left fail
/// with std::bad_alloc: otherwise the system would kill some process, this one or another, without
/// a message. A lower limit set by the user stays.
void limit_memory_to_what_is_left();

}  // namespace tagfield
