// SPDX-License-Identifier: Apache-2.0
/// @file
/// A scenario at one moment: where everything is, without any reads.
#pragma once

#include <cstdint>
#include <vector>

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

/// Obstacles to waves that stand still during the whole run. Warns of what is left out: obstacles
/// that move or come and go, and robots' bodies.
std::vector<MovingBody> standing_bodies(const Scenario& scenario, Diagnostics& diagnostics);

/// Leaves out the tags that are absent at `time`, and warns of each of the first few.
void leave_out_absent_tags(Time time, Scenario& scenario, Diagnostics& diagnostics);

}  // namespace tagfield
