// SPDX-License-Identifier: Apache-2.0
/// @file
/// Checks of TraceOptions and of the ends of paths.
#pragma once

#include "tagfield/propagation/trace_paths.h"

namespace tagfield {

/// Throws Error, naming the option, unless 0 ≤ order ≤ kMaxBounces, max_length_m ≥ 0 and
/// 0 ≤ mount_depth_m ≤ 1.
void check(const TraceOptions& options);

/// Whether an end may be at `p_W`: finite, and within the limit for vertices (1e9 m from the
/// world's origin along each axis).
inline bool is_place(const Eigen::Vector3d& p_W) {
  return p_W.allFinite() && p_W.cwiseAbs().maxCoeff() <= 1e9;
}

}  // namespace tagfield
