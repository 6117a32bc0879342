// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/stoppable.h"

#include <utility>

namespace tagfield {

void make_stoppable(const std::atomic<bool>* stop, OnLocating& on_locating, TraceReplies& trace) {
  if (stop == nullptr) return;
  const auto check = [stop] {
    if (*stop) throw LocatingStopped{};
  };
  on_locating = [check, inner = std::move(on_locating)](const std::string& what, double share) {
    check();
    if (inner) inner(what, share);
  };
  if (!trace) return;
  trace = [check, inner = std::move(trace)](const std::string& tag, const Eigen::Vector3d& p_WT,
                                            const std::map<std::string, TracedFrom>& antennas) {
    check();
    return inner(tag, p_WT, antennas);
  };
}

}  // namespace tagfield
