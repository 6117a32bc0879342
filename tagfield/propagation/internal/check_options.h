/// @file
/// TraceOptions' ranges.
#pragma once

#include "tagfield/propagation/trace_paths.h"

namespace tagfield {

/// Throws Error, naming the option, unless 0 ≤ order ≤ kMostBounces, most_length_m ≥ 0 and
/// 0 ≤ mount_depth_m ≤ 1.
void check(const TraceOptions& options);

}  // namespace tagfield
