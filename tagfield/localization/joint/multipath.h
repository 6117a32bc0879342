// SPDX-License-Identifier: Apache-2.0
/// @file
/// Joint estimation of all tags and the pose error in a known world: the effect of its reflections
/// on the phases is traced and removed. docs/methods.md has the steps and the figures.
#pragma once

#include "tagfield/localization/method.h"

namespace tagfield {

struct MultipathOptions {
  double min_directness = 0.1;  ///< Minimum share of the direct path in used replies; in (0, 1].
  int rounds = 9;               ///< Rounds of tracing and fitting; at least 1.
};

/// Method "multipath". Without a known world (LocalizationProblem::trace), no tag is located.
/// Throws Error on options out of range.
Method multipath_method(const MultipathOptions& options = {});

}  // namespace tagfield
