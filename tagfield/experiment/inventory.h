// SPDX-License-Identifier: Apache-2.0
/// @file
/// A run as an inventory: which tags were read, by which readers, and how soon, whether or not they
/// are located.
#pragma once

#include <string>

#include "tagfield/report/summary.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/stream/recording.h"

namespace tagfield {

/// Whether all antennas are stationary.
bool all_antennas_rest(const Scenario& scenario);

/// Why there is no localization, in one line: the scenario does not request it, or its method needs
/// a moving antenna and there is none. "" if tags are located.
std::string why_inventory_alone(const Scenario& scenario);

/// The summary of `duration_s` of reads. Tags belong to the zone in which they appeared. Without
/// zones they belong to that of the reader whose antenna they came nearest to, if there are several
/// and all antennas are stationary. A tag that never appeared belongs to no zone.
InventorySummary inventory_of(const Scenario& scenario, const Recording& recording,
                              double duration_s);

}  // namespace tagfield
