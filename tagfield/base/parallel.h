// SPDX-License-Identifier: Apache-2.0
/// @file
/// A loop over several threads.
#pragma once

#include <cstddef>
#include <functional>

namespace tagfield {

/// Calls `body(i)` once for each i in [0, count), on up to `threads` threads (at least one; fewer
/// if the machine can't start more), in no particular order. Bodies must not write to shared data.
/// An exception thrown by a body stops the loop and is rethrown here; if several bodies throw, the
/// exception of the lowest such i.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body);

}  // namespace tagfield
