// SPDX-License-Identifier: Apache-2.0
/// @file
/// Places amid reflections: by stretches of the way, each believed as far as its waves add up, and
/// with an expected error that is the spread of their likelihood. docs/methods.md has the equations
/// and the figures.
#pragma once

#include <cstddef>

#include "tagfield/localization/method.h"

namespace tagfield {

struct RobustOptions {
  double max_range_m = 12.0;       ///< Half of the reads are from nearer; over 0.
  std::size_t search_reads = 800;  ///< The search takes so many at most; at least 1.
};

/// "robust": all tags, one by one. Throws Error on options out of their range.
Method robust_method(const RobustOptions& options = {});

}  // namespace tagfield
