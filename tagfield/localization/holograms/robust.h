// SPDX-License-Identifier: Apache-2.0
/// @file
/// Localization amid reflections: from sections of the antenna's path, each weighted by how well
/// its phasors add up, with the spread of their likelihood as the expected error. docs/methods.md
/// has the equations and the figures.
#pragma once

#include <cstddef>

#include "tagfield/localization/method.h"

namespace tagfield {

struct RobustOptions {
  double max_range_m = 12.0;       ///< Half of the reads are from within this range; over 0.
  std::size_t search_reads = 800;  ///< Maximum number used by the search; at least 1.
};

/// Method "robust": each tag independently. Throws Error on options out of range.
Method robust_method(const RobustOptions& options = {});

}  // namespace tagfield
