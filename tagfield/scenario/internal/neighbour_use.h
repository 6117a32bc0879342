// SPDX-License-Identifier: Apache-2.0
/// @file
/// Whether what a scenario says of readers and tags beside one another does anything.
#pragma once

#include "tagfield/base/error.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Throws Error at the place of an antenna's `interference: on` where no other reader ever sends
/// while it does; warns of `tag_coupling: on` with one tag, of a `spectrum_mask` that no other
/// reader minds, and of turns (`port_dwell_s`, `sharing: time`) that there is nobody to take with.
void require_use_of_neighbours(const Scenario& scenario, Diagnostics& diagnostics);

}  // namespace tagfield
