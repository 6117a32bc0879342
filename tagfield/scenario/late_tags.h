// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tags that appear only after a run.
#pragma once

#include "tagfield/base/error.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Warns, once for all, of tags that appear after the run's end at `end_s` [s] ≥ 0.
void warn_of_late_tags(const Scenario& scenario, double end_s, Diagnostics& diagnostics);

}  // namespace tagfield
