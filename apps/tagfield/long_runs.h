// SPDX-License-Identifier: Apache-2.0
/// @file
/// Warnings about long runs.
#pragma once

#include "tagfield/base/error.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Warns, before a scenario with a duration is run, if it takes hours, or if `is_kept` and the
/// tables will not fit into the memory of most machines. Throws Error for what no machine can
/// complete.
void warn_of_long_run(const Scenario& scenario, bool is_kept, Diagnostics& diagnostics);

}  // namespace tagfield
