/// @file
/// Work that may go wrong in a library: done by a process of its own, so that nothing but it is
/// lost.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace tagfield {

/// What such work may take.
struct ProcessLimits {
  unsigned seconds = 2;                      ///< Of processor time.
  std::uint64_t memory_bytes = 256'000'000;  ///< Beyond what there is already.
};

/// What `work` returns in a copy of this process. Throws Error with the message of what `work`
/// throws; or, where the process ends otherwise, with one that begins with `what` and says how.
std::string from_own_process(const std::string& what, const ProcessLimits& limits,
                             const std::function<std::string()>& work);

}  // namespace tagfield
