// SPDX-License-Identifier: Apache-2.0
/// @file
/// A live world and tag estimates as JSON; docs/live.md and openapi.json describe the contents.
#pragma once

#include <vector>

#include "adapters/http/world_json.h"
#include "tagfield/live/live_estimates.h"
#include "tagfield/live/live_world.h"

namespace tagfield::http {

Json antennas_json(const LiveWorld& world);
Json tags_json(const LiveWorld& world);

/// [tag, x, y, z, [xx, xy, yy]] for each located tag, [tag, null] for the others.
Json estimate_rows(const std::vector<LiveEstimate>& estimates);
/// All estimates in full.
Json estimates_json(const LiveEstimates& estimates);

}  // namespace tagfield::http
