// SPDX-License-Identifier: Apache-2.0
/// @file
/// Whether a scenario's settings for neighbouring readers and tags have an effect.
#pragma once

#include "tagfield/base/error.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Throws Error at the location of an antenna's `interference: on` if no other reader ever
/// transmits at the same time, of its `sharing` or its channels if another antenna of its reader
/// has others. Warns about `tag_coupling: on` with a single tag, a `spectrum_mask`
/// that affects no other reader, `target: b` if no antenna sets flags to B, and turns
/// (`port_dwell_s`, `sharing: time`) with nobody to take turns with.
void require_use_of_neighbours(const Scenario& scenario, Diagnostics& diagnostics);

}  // namespace tagfield
