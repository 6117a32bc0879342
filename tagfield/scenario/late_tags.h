// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a scenario states for after its run.
#pragma once

#include "tagfield/base/error.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Warns, once for all, of tags that appear after the run's end at `end_s` [s] ≥ 0.
void warn_of_late_tags(const Scenario& scenario, double end_s, Diagnostics& diagnostics);

/// Same, of robots that would be kidnapped only then.
void warn_of_late_kidnappings(const Scenario& scenario, double end_s, Diagnostics& diagnostics);

}  // namespace tagfield
