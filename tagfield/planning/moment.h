// SPDX-License-Identifier: Apache-2.0
/// @file
/// A scenario at one moment: where everything is, without any reads.
#pragma once

#include <cstdint>

#include "tagfield/scenario/scenario.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield {

/// The scenario with robots that drive by themselves replaced by ones that follow straight lines
/// through their waypoints or goals, since their true paths take a whole run to compute. Warns of
/// each such robot. Returns other scenarios unchanged.
Scenario as_planned(const Scenario& scenario, Diagnostics& diagnostics);

/// The simulation, run to `time` without reads: its last step ends at or after `time`. Throws Error
/// if the run is over before.
Simulation simulation_at(const Scenario& scenario, std::uint64_t seed, Time time);

/// Why the tag is absent at `time`: "not there yet (appears at 12 s)"; "" if it is present.
std::string absence_of(const TagSpec& tag, Time time);

}  // namespace tagfield
