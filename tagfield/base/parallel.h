// SPDX-License-Identifier: Apache-2.0
/// @file
/// A loop over several threads.
#pragma once

#include <cstddef>
#include <functional>

namespace tagfield {

/// Calls `body(i)` once for each i in [0, count), on up to `threads` threads (at least one, fewer
/// where the machine gives no more), in no set order. Bodies must not share what they write. An
/// exception thrown by a body stops the loop and is thrown again here; where several throw, that of
/// the lowest i among those.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body);

}  // namespace tagfield
