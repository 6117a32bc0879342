// SPDX-License-Identifier: Apache-2.0
/// @file
/// A scenario's world as known to localization: how a tag's reply propagates.
#pragma once

#include "tagfield/localization/problem.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Traces replies through the scenario's world with the antennas' own models. Tags have their model
/// and orientation of the scenario; those with unknown IDs have the default model and stand
/// upright. Diffuse waves are left out, as they are unknown. Null if nothing is reflected: no
/// antenna's model has reflections, or the world has no surfaces.
TraceReplies traced_replies(const Scenario& scenario);

}  // namespace tagfield
