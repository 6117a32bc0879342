// SPDX-License-Identifier: Apache-2.0
/// @file
/// A scenario at one moment: where everything is, without a read being made.
#pragma once

#include <cstdint>

#include "tagfield/scenario/scenario.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield {

/// The scenario with its robots driving by themselves taken to follow straight lines over their
/// waypoints or goals, as what they really drive takes a whole run to find out. Each one is warned
/// of. Other scenarios come back as they are.
Scenario as_planned(const Scenario& scenario, Diagnostics& diagnostics);

/// The simulation run to `time`, without reads: its last step ends at or after it. Throws Error if
/// the run is over before.
Simulation simulation_at(const Scenario& scenario, std::uint64_t seed, Time time);

/// Why the tag is not there at `time`: "not there yet (appears at 12 s)"; "" where it is.
std::string absence_of(const TagSpec& tag, Time time);

}  // namespace tagfield
