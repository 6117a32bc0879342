// SPDX-License-Identifier: Apache-2.0
/// @file
/// TraceOptions' ranges.
#pragma once

#include "tagfield/propagation/trace_paths.h"

namespace tagfield {

/// Throws Error, naming the option, unless 0 ≤ order ≤ kMostBounces, most_length_m ≥ 0 and
/// 0 ≤ mount_depth_m ≤ 1.
void check(const TraceOptions& options);

/// Whether an end can be there: finite, and as near to the world's origin as its vertices must be.
inline bool is_place(const Eigen::Vector3d& p_W) {
  return p_W.allFinite() && p_W.cwiseAbs().maxCoeff() <= 1e9;
}

}  // namespace tagfield
