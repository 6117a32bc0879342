// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/internal/stoppable.h"

#include <utility>

namespace tagfield {
namespace {

void check(const std::atomic<bool>& stop) {
  if (stop) throw LocatingStopped{};
}

}  // namespace

OnLocating stoppable(OnLocating on_locating, const std::atomic<bool>* stop) {
  if (stop == nullptr) return on_locating;
  return [on_locating = std::move(on_locating), stop](const std::string& what, double share) {
    check(*stop);
    if (on_locating) on_locating(what, share);
  };
}

TraceReplies stoppable(TraceReplies trace, const std::atomic<bool>* stop) {
  if (stop == nullptr || !trace) return trace;
  return [trace = std::move(trace), stop](const std::string& tag, const Eigen::Vector3d& p_WT,
                                          const std::map<std::string, TracedFrom>& antennas) {
    check(*stop);
    return trace(tag, p_WT, antennas);
  };
}

}  // namespace tagfield
