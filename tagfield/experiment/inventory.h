// SPDX-License-Identifier: Apache-2.0
/// @file
/// A run as an inventory: which tags were read, by whom, and how soon, whether they are located or
/// not.
#pragma once

#include <string>

#include "tagfield/report/summary.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// Whether all antennas stand still.
bool all_antennas_rest(const Scenario& scenario);

/// Why nothing is located, in one line: the scenario asks for nothing, or its method needs an
/// antenna that moves and none does. "" where tags are located.
std::string why_inventory_alone(const Scenario& scenario);

/// What `duration_s` of reads come to. Tags count for the zone that they begin in; without zones
/// for that of the reader that is nearest to them then, where there are several.
InventorySummary inventory_of(const Scenario& scenario, const std::vector<TagRead>& reads,
                              double duration_s);

}  // namespace tagfield
