// SPDX-License-Identifier: Apache-2.0
/// @file
/// All tags and the pose error together, with a known world: what its reflections do to the phases
/// is traced and taken out. docs/methods.md has the steps and the figures.
#pragma once

#include "tagfield/localization/method.h"

namespace tagfield {

struct MultipathOptions {
  double least_directness = 0.1;  ///< Of replies that are used (TracedReply); in (0, 1].
  int rounds = 9;                 ///< Of tracing and fitting; at least 1.
};

/// "multipath": where no world is known (LocalizationProblem::trace), no tag is located. Throws
/// Error on options out of their range.
Method multipath_method(const MultipathOptions& options = {});

}  // namespace tagfield
