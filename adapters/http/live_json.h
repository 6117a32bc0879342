// SPDX-License-Identifier: Apache-2.0
/// @file
/// A live world and what is found in it as JSON: docs/live.md and openapi.json say what is in it.
#pragma once

#include <vector>

#include "adapters/http/world_json.h"
#include "tagfield/live/live_estimates.h"
#include "tagfield/live/live_world.h"

namespace tagfield::http {

Json antennas_json(const LiveWorld& world);
Json tags_json(const LiveWorld& world);

/// [tag, x, y, z, [xx, xy, yy]] of each that is located, [tag, null] of the others.
Json estimate_rows(const std::vector<LiveEstimate>& estimates);
/// All that is known of them.
Json estimates_json(const LiveEstimates& estimates);

}  // namespace tagfield::http
